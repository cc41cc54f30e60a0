"""Make the meshes of the scenes again from their geometry, with Gmsh's Python module (Debian: python3-gmsh).

    python3 scenes/meshes/make.py [--output DIR]          default: beside the geometry, over the meshes that are there

With Gmsh 4.8.4 the files come out as committed, byte for byte.
"""

import argparse
from pathlib import Path

import gmsh

HERE = Path(__file__).resolve().parent
MESHES = {"brake-pad": (3, 4.1), "press-fit": (2, 2.2)}  # dimension, version of the format


def make(name: str, folder: Path) -> Path:
    """NAME.msh in the folder, from NAME.geo here."""
    dimension, version = MESHES[name]
    mesh = folder / f"{name}.msh"
    gmsh.initialize(readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(HERE / f"{name}.geo"))
        gmsh.model.mesh.generate(dimension)
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.write(str(mesh))
    finally:
        gmsh.finalize()
    return mesh


def main() -> None:
    """Every mesh."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", type=Path, default=HERE, metavar="DIR")
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    for name in MESHES:
        print(make(name, folder))


if __name__ == "__main__":
    main()
