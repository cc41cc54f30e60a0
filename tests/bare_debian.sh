#!/bin/sh
# The Debian packages install and run on a bare Debian 12: made here, installed with apt in a system of debootstrap's,
# where a scene is run from an unprivileged user's folder and the example is built. Needs root (chroot) and the network;
# the mirror is that of this machine. Usage: sh tests/bare_debian.sh FOLDER [PACKAGES]
# In FOLDER the system is made, and kept bare as bookworm.tar. PACKAGES: a folder that has them already.
set -eu
folder=$(realpath -m "${1:?a folder}") packages=$(realpath -m "${2:-build-package}")
. "$(dirname "$0")/../.ci/environment.sh"
system="$folder/system"
. tests/support/debian_root.sh
sh .ci/packages.sh dpkg-dev file
mkdir -p "$folder"

[ $# -gt 1 ] || cmake --workflow --preset package >"$folder/package.log" 2>&1 || { tail -n 40 "$folder/package.log" >&2; exit 1; }
program=$(ls "$packages"/thermocontact_*.deb) library=$(ls "$packages"/thermocontact-dev_*.deb)

# What the packages say of themselves
for package in "$program" "$library"; do
    dpkg-deb --info "$package"
    dpkg-deb --contents "$package" | awk '{print $6}' | grep -q "^./usr/" || { echo "$package: not below /usr" >&2; exit 1; }
    if dpkg-deb --contents "$package" | grep -v '^[-dl]\(rwxr-xr-x\|rw-r--r--\|rwxrwxrwx\) root/root'; then
        echo "$package: these are not root's, or have odd permissions" >&2
        exit 1
    fi
done
dpkg-deb --field "$program" Depends | grep -q libpetsc || { echo "no shared libraries in Depends" >&2; exit 1; }

make_system bookworm
enter_system
get="apt-get install -y -qq --no-install-recommends"

# The program alone: nothing but its package and what that depends on
cp "$program" "$library" "$system/tmp"
inside sh -c "apt-get update -qq && $get /tmp/$(basename "$program") >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }"
inside useradd --create-home user
as_user() { inside su - user -c "$1"; }
as_user "thermocontact --version"
as_user "thermocontact check /usr/share/thermocontact/scenes/paper.toml >check.txt"
as_user "thermocontact run /usr/share/thermocontact/scenes/paper.toml --quiet --output results"
as_user "grep -q '\"status\": \"completed\"' results/summary.json && test -s results/fields.pvd"
# by the program with PETSc, too
as_user "thermocontact run /usr/share/thermocontact/scenes/paper.toml --quiet --output krylov --set mesh.cells=[8,8] \
    --set 'solver.strategy=\"newton-krylov\"'"
for file in man/man1/thermocontact.1 bash-completion/completions/thermocontact zsh/vendor-completions/_thermocontact \
    doc/thermocontact/index.md; do
    [ -e "$system/usr/share/$file" ] || [ -e "$system/usr/share/$file.gz" ] || { echo "no $file" >&2; exit 1; }
done
if inside sh -c "ls /usr/bin/c++ /usr/include/thermocontact" 2>/dev/null; then
    echo "the program's package brings along what only building needs" >&2
    exit 1
fi

# The library: the example is built with what its package depends on, and a compiler
inside sh -c "$get g++ make /tmp/$(basename "$library") >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }"
as_user "cmake -S /usr/share/doc/thermocontact/examples/step_by_step -B example >/dev/null && cmake --build example >/dev/null"
as_user "example/step_by_step /usr/share/thermocontact/scenes/paper.toml bottom 0.1 mesh.cells=[8,8] time.steps=8 | tail -n 1"

# Gone without a trace
inside apt-get purge -y -qq thermocontact thermocontact-dev >/dev/null 2>&1
if inside find /usr -iname '*thermocontact*' | grep .; then
    echo "left behind" >&2
    exit 1
fi
echo "the packages install, run and go"
