"""Generate C kernels from form files, those of this folder or of another one, with FFCx.

    generate.py form FILE CELL DEGREE OUTPUT_DIR [FOLDER]    FOLDER/FILE.py -> FILE_CELL_DEGREE.c and .h;
                                                             PACKAGE.FILE for a file in a package of FOLDER
    generate.py table NAME OUTPUT_DIR STEM...                all generated headers -> kernel_table.c, symbols NAME_...
    generate.py describe LAW LAW=FILE                        what a law file says of itself, as JSON
    generate.py laws CELL DEGREE PLANE OUTPUT_DIR LAW=FILE...    every form that law files enter -> the shared library
                                                             laws.so with a table of symbols laws_...; PLANE: strain
                                                             or stress, of bodies in 2D
    generate.py built-in OUTPUT_DIR                          the built-in law files -> law_table.c
    generate.py flags                                        the include folder of ufcx.h

Exit 2: a law file is wrong; standard error says FILE:LINE: why.
"""

import concurrent.futures
import hashlib
import json
import logging
import os
import pathlib
import re
import subprocess
import sys
from typing import NoReturn

FORMS = pathlib.Path(__file__).resolve().parent

STUB = """import in_force, space

space.select("{cell}", {degree})
in_force.replace({laws}, plane_strain={plane_strain})
from {file} import *
from ufl import Form

for name, form in list(globals().items()):
    if isinstance(form, Form):
        globals()[name] = space.completed(form)
forms = [form for form in list(globals().values()) if isinstance(form, Form)]
globals().update(in_force.constants())
"""

TABLE = """/* Generated: every compiled form by name, and what the forms were compiled with. */
#include "fem/kernel_table.h"

{includes}
const struct thermocontact_kernel {name}_kernels[] = {{
{rows}
}};
const int {name}_kernel_count = {count};
const char* const {name}_kernel_versions = "{versions}";
const char* const {name}_forms_digest = "{digest}";
"""

LAW_TABLE = """/* Generated: the built-in law files, and what they say of themselves. */
#include "laws/law_table.h"

const struct thermocontact_law thermocontact_laws[] = {{
{rows}
}};
const int thermocontact_law_count = {count};
const char* const thermocontact_law_tools = "{versions}; forms {digest}";
"""


def generate_form(
    file: str,
    cell: str,
    degree: str,
    output: str,
    folder: str = str(FORMS),
    laws: dict[str, str] = {},
    plane_strain: bool = False,
) -> None:
    """Write the stub that selects cell, degree and laws, and run FFCx on it in the output folder."""
    stub = pathlib.Path(output) / f"{file.split('.')[-1]}_{cell}_{degree}.py"
    stub.write_text(STUB.format(file=file, cell=cell, degree=degree, laws=laws, plane_strain=plane_strain))
    command = f"import sys; sys.path[:0] = {[folder, str(FORMS)]!r}; from ffcx.main import main; main()"
    run = subprocess.run(
        [sys.executable, "-B", "-c", command, stub.name], cwd=output, stderr=subprocess.PIPE, text=True
    )
    sys.stderr.write("" if laws and run.returncode else run.stderr)
    if run.returncode and laws:
        refuse(
            ", ".join(laws.values()),
            f"{file} cannot be compiled for {cell}s: {run.stderr.strip().splitlines()[-1]}",
        )
    run.check_returncode()


def write_if_new(target: pathlib.Path, text: str) -> None:
    """Leave it alone when nothing changed, so that nothing is rebuilt."""
    if not target.exists() or target.read_text() != text:
        target.write_text(text)


def forms_digest() -> str:
    """Of all files that kernels are made of."""
    files = sorted(FORMS.glob("*.py")) + sorted((FORMS / "laws").glob("*.py"))
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:16]


def versions() -> str:
    """Of what makes kernels."""
    import ffcx
    import ufl

    return f"FFCx {ffcx.__version__}, UFL {ufl.__version__}"


def generate_table(name: str, output: str, stems: list[str]) -> None:
    """List the forms that the headers declare."""
    rows = []
    for stem in stems:
        file, cell, degree = stem.rsplit("_", 2)
        header = (pathlib.Path(output) / f"{stem}.h").read_text()
        for form in re.findall(rf"extern ufcx_form\* form_{stem}_(\w+);", header):
            rows.append(f'    {{"{file}.{form}", "{cell}", {degree}, &form_{stem}_{form}}},')
    text = TABLE.format(
        name=name,
        includes="".join(f'#include "{stem}.h"\n' for stem in stems),
        rows="\n".join(rows),
        count=len(rows),
        versions=versions(),
        digest=forms_digest(),
    )
    write_if_new(pathlib.Path(output) / "kernel_table.c", text)


def affected(laws: dict[str, str]) -> list[str]:
    """The form files that one of these laws enters; no built-in law asks for what a form offers it as a lambda."""
    files = []
    for path in sorted(FORMS.glob("*.py")):
        kinds = re.findall(r'(?<!lambda: )\b(?:law|tensor|stress_rows)\("(\w+)"', path.read_text())
        if any(kind in laws for kind in kinds) and path.stem not in ("in_force", "law", "generate"):
            files.append(path.stem)
    return files


def generate_laws(cell: str, degree: str, plane: str, output: str, laws: dict[str, str]) -> None:
    """Every form that the laws enter, their table, and a library of both."""
    files = affected(laws)
    if "friction" in laws and "speed" in describe({"friction": laws["friction"]})["friction"]["takes"]:
        files.remove("coulomb")  # which is of bounds that do not depend on the speed
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        strain = plane == "strain"
        list(
            pool.map(
                lambda file: generate_form(file, cell, degree, output, laws=laws, plane_strain=strain), files
            )
        )
        stems = [f"{file}_{cell}_{degree}" for file in files]
        generate_table("laws", output, stems)
        objects = list(pool.map(lambda stem: compile_object(stem, output), ["kernel_table", *stems]))
    run_compiler("-shared", "-Wl,-Bsymbolic", "-o", f"{output}/laws.so", *objects)


def compile_object(stem: str, output: str) -> str:
    """With the flags that portable kernels have: several machines may share what is compiled."""
    import ffcx.codegeneration

    target = f"{output}/{stem}.o"
    folders = (ffcx.codegeneration.get_include_path(), FORMS.parent / "src", output)
    run_compiler(
        "-O3",
        "-DNDEBUG",
        "-w",
        "-fno-math-errno",
        "-fPIC",
        *(f"-I{folder}" for folder in folders),
        "-include",
        "fem/kernel_math.h",
        "-c",
        f"{output}/{stem}.c",
        "-o",
        target,
    )
    return target


def run_compiler(*arguments: str) -> None:
    compiler = os.environ.get("CC") or "cc"
    try:
        run = subprocess.run([*compiler.split(), *arguments], stderr=subprocess.PIPE, text=True)
    except OSError as error:
        sys.exit(f"the C compiler {compiler}: {error.strerror}")
    if run.returncode:
        sys.exit(f"the C compiler {compiler}: {' '.join(run.stderr.split())[-300:]}")


def refuse(place: str, why: str) -> NoReturn:
    """End the program: a law file is wrong."""
    print(f"{place}: {why}", file=sys.stderr)
    sys.exit(2)


def describe(laws: dict[str, str]) -> dict[str, dict[str, object]]:
    """What the law files say of themselves, by law; ends the program where one is wrong."""
    import in_force
    from describe import description

    logging.disable(logging.CRITICAL)  # UFL's own, which it writes to standard output
    found = {}
    for kind, path in laws.items():
        try:
            found[kind] = description(kind, path)
        except in_force.LawError as error:
            refuse(f"{path}:{error.line}" if error.line else path, str(error))
    return found


def generate_built_in(output: str) -> None:
    """The text and the description of each built-in law file, as C strings."""
    rows = []
    for path in sorted((FORMS / "laws").glob("*.py")):
        facts = describe({path.stem: str(path)})[path.stem]
        strings = (path.stem, path.read_text(), json.dumps(facts))
        rows.append("    {" + ",\n     ".join(json.dumps(text, ensure_ascii=True) for text in strings) + "},")
    text = LAW_TABLE.format(rows="\n".join(rows), count=len(rows), versions=versions(), digest=forms_digest())
    write_if_new(pathlib.Path(output) / "law_table.c", text)


def main() -> None:
    """Dispatch on the first word of the command line."""
    command, *arguments = sys.argv[1:]
    if command == "form":
        generate_form(*arguments)
    elif command == "table":
        generate_table(arguments[0], arguments[1], arguments[2:])
    elif command == "describe":
        kind, law = arguments
        print(json.dumps(describe(dict([law.split("=", 1)]))[kind]))
    elif command == "laws":
        cell, degree, plane, output = arguments[:4]
        laws = dict(pair.split("=", 1) for pair in arguments[4:])
        files = {kind: os.path.abspath(path) for kind, path in laws.items()}
        generate_laws(cell, degree, plane, output, files)
    elif command == "built-in":
        generate_built_in(*arguments)
    elif command == "flags":
        import ffcx.codegeneration

        print(ffcx.codegeneration.get_include_path(), end="")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
