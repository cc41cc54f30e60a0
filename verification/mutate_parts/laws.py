"""Law files: what is kept, which kernels are in force, what is refused."""

from .mutation import Mutation

MUTATIONS = (
    Mutation(
        "law-cache-content",
        "src/laws/law_file.cpp",
        'all += "\\n" + file.kind + " " + file.digest;',
        'all += "\\n" + file.kind;',
        "missing",
        "a changed law is compiled anew",
    ),
    Mutation(
        "law-kernels-order",
        "src/fem/kernel.cpp",
        "for (const KernelTable table : {own, others}) {",
        "for (const KernelTable table : {others, own}) {",
        "index",
        "a scene's own law comes before the built-in one",
    ),
    Mutation(
        "law-restart",
        "src/output/checkpoint.cpp",
        "own != scene.laws.end() && own->second != law",
        "own != scene.laws.end() && own->second == law",
        "sign",
        "a restart under a changed law is refused",
    ),
    Mutation(
        "law-bound-of-speed",
        "src/scene/laws.cpp",
        'law->description.depends_on("speed")',
        'law->description.depends_on("slip")',
        "missing",
        "Coulomb's law itself knows no bound that takes the speed",
    ),
    Mutation(
        "sha256-rotation",
        "src/laws/sha256.cpp",
        "std::rotr(w[t - 2], 19)",
        "std::rotr(w[t - 2], 18)",
        "index",
        "SHA-256 as the standard has it",
    ),
)
