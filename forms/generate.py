"""Generate C kernels from the form files of this folder with FFCx.

    generate.py form FILE CELL DEGREE OUTPUT_DIR     one form file -> FILE_CELL_DEGREE.c and .h
    generate.py table OUTPUT_DIR STEM...             all generated headers -> kernel_table.c
    generate.py flags                                the include folder of ufcx.h
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
from ufl.form import Form

forms = [form for form in list(globals().values()) if isinstance(form, Form)]
"""

TABLE = """/* Generated: every compiled form by name, and what the forms were compiled with. */
#include "fem/kernel_table.h"

{includes}
const struct thermocontact_kernel thermocontact_kernels[] = {{
{rows}
}};
const int thermocontact_kernel_count = {count};
const char* const thermocontact_kernel_versions = "{versions}";
const char* const thermocontact_forms_digest = "{digest}";
"""


def generate_form(file: str, cell: str, degree: str, output: str) -> None:
    """Write the stub that selects cell and degree, and run FFCx on it in the output folder."""
    stub = pathlib.Path(output) / f"{file}_{cell}_{degree}.py"
    stub.write_text(STUB.format(file=file, cell=cell, degree=degree))
    command = f"import sys; sys.path.insert(0, {str(FORMS)!r}); from ffcx.main import main; main()"
    subprocess.run([sys.executable, "-c", command, stub.name], cwd=output, check=True)


def generate_table(output: str, stems: list[str]) -> None:
    """List the forms that the headers declare; left alone when nothing changed, so that nothing is rebuilt."""
    import ffcx
    import ufl

    rows = []
    for stem in stems:
        file, cell, degree = stem.rsplit("_", 2)
        header = (pathlib.Path(output) / f"{stem}.h").read_text()
        for name in re.findall(rf"extern ufcx_form\* form_{stem}_(\w+);", header):
            rows.append(f'    {{"{file}.{name}", "{cell}", {degree}, &form_{stem}_{name}}},')
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sorted(FORMS.glob("*.py"))))
    text = TABLE.format(
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
        generate_table(arguments[0], arguments[1:])
    elif command == "flags":
        import ffcx.codegeneration

        print(ffcx.codegeneration.get_include_path(), end="")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
