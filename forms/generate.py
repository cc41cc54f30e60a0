"""Generate C kernels from form files, those of this folder or of another one, with FFCx.

    generate.py form FILE CELL DEGREE OUTPUT_DIR [FOLDER]    FOLDER/FILE.py -> FILE_CELL_DEGREE.c and .h;
                                                             PACKAGE.FILE for a file in a package of FOLDER
    generate.py table NAME OUTPUT_DIR STEM...                all generated headers -> kernel_table.c, symbols NAME_...
    generate.py flags                                        the include folder of ufcx.h
"""

import hashlib
import pathlib
import re
import subprocess
import sys

FORMS = pathlib.Path(__file__).resolve().parent

STUB = """import space

space.select("{cell}", {degree})
from {file} import *
from ufl import Form

for name, form in list(globals().items()):
    if isinstance(form, Form):
        globals()[name] = space.completed(form)
forms = [form for form in list(globals().values()) if isinstance(form, Form)]
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


def generate_form(file: str, cell: str, degree: str, output: str, folder: str = str(FORMS)) -> None:
    """Write the stub that selects cell and degree, and run FFCx on it in the output folder."""
    stub = pathlib.Path(output) / f"{file.split('.')[-1]}_{cell}_{degree}.py"
    stub.write_text(STUB.format(file=file, cell=cell, degree=degree))
    command = f"import sys; sys.path[:0] = {[folder, str(FORMS)]!r}; from ffcx.main import main; main()"
    subprocess.run([sys.executable, "-c", command, stub.name], cwd=output, check=True)


def generate_table(name: str, output: str, stems: list[str]) -> None:
    """List the forms that the headers declare; left alone when nothing changed, so that nothing is rebuilt."""
    import ffcx
    import ufl

    rows = []
    for stem in stems:
        file, cell, degree = stem.rsplit("_", 2)
        header = (pathlib.Path(output) / f"{stem}.h").read_text()
        for form in re.findall(rf"extern ufcx_form\* form_{stem}_(\w+);", header):
            rows.append(f'    {{"{file}.{form}", "{cell}", {degree}, &form_{stem}_{form}}},')
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sorted(FORMS.glob("*.py"))))
    text = TABLE.format(
        name=name,
        includes="".join(f'#include "{stem}.h"\n' for stem in stems),
        rows="\n".join(rows),
        count=len(rows),
        versions=f"FFCx {ffcx.__version__}, UFL {ufl.__version__}",
        digest=digest.hexdigest()[:16],
    )
    target = pathlib.Path(output) / "kernel_table.c"
    if not target.exists() or target.read_text() != text:
        target.write_text(text)


def main() -> None:
    """Dispatch on the first word of the command line."""
    command, *arguments = sys.argv[1:]
    if command == "form":
        generate_form(*arguments)
    elif command == "table":
        generate_table(arguments[0], arguments[1], arguments[2:])
    elif command == "flags":
        import ffcx.codegeneration

        print(ffcx.codegeneration.get_include_path(), end="")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
