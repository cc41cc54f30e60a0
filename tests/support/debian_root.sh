# shellcheck shell=sh disable=SC2154,SC2016  # $system and $folder are the caller's; apt expands SITE
# Sourced by tests that need a system of their own: Debian of another age, or one that has nothing installed. Needs root.
# Of $system, a folder: make_system SUITE unpacks it from $folder/SUITE.tar, made by debootstrap where that is not there;
# inside COMMAND... runs in it, with nothing of this environment. What is mounted there is let go at exit.

[ "$(id -u)" -eq 0 ] || { echo "a system of its own can only be entered by root" >&2; exit 1; }

leave_system() {
    for place in dev/shm sys proc; do
        mountpoint -q "$system/$place" && umount "$system/$place"
    done
    return 0
}

make_system() { # SUITE
    leave_system
    rm -rf --one-file-system "$system"
    if [ ! -f "$folder/$1.tar" ]; then
        sh .ci/packages.sh debootstrap
        # the mirror of this machine
        mirror=$(apt-get indextargets --format '$(SITE)' 'Component: main' 'Created-By: Packages' | grep -v security | head -n 1)
        debootstrap --variant=minbase "$1" "$system" "$mirror" >"$folder/debootstrap.log"
        tar -C "$system" -cf "$folder/$1.part" .
        mv "$folder/$1.part" "$folder/$1.tar"
    else
        mkdir -p "$system"
        tar -C "$system" -xf "$folder/$1.tar"
    fi
    echo force-unsafe-io >"$system/etc/dpkg/dpkg.cfg.d/unsafe-io" # it is made again rather than repaired
}

enter_system() {
    leave_system
    trap leave_system EXIT
    cp /etc/resolv.conf "$system/etc/resolv.conf"
    # whom this machine trusts, where npm asks
    mkdir -p "$system/etc/ssl/certs"
    [ ! -f /etc/ssl/certs/ca-certificates.crt ] || cp /etc/ssl/certs/ca-certificates.crt "$system/etc/ssl/of-the-host.crt"
    mount -t proc proc "$system/proc"
    mount -t sysfs -o ro sysfs "$system/sys"
    mkdir -p "$system/dev/shm"
    mount -t tmpfs tmpfs "$system/dev/shm"
}

inside() {
    chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        NODE_EXTRA_CA_CERTS=/etc/ssl/of-the-host.crt "$@"
}
