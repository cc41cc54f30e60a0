"""The few names that differ between dolfinx 0.5 and 0.9, each behind one function."""

import functools
import inspect
from typing import Any

import dolfinx
import numpy as np
import numpy.typing as npt
import ufl
from dolfinx import fem


def lagrange_space(mesh: Any, degree: int, components: int = 1) -> Any:
    """Scalar, or a vector of several components; degree 0 is piecewise constant."""
    element = ("Lagrange" if degree else "DG", degree)
    if hasattr(fem, "functionspace"):
        return fem.functionspace(mesh, element if components == 1 else (*element, (components,)))
    if components > 1:
        return fem.VectorFunctionSpace(mesh, element, dim=components)
    return fem.FunctionSpace(mesh, element)


def simplex_domain(kind: str, dimension: int) -> Any:
    """UFL's domain of meshes of triangles or tetrahedra with straight edges."""
    try:
        import basix.ufl
    except ImportError:
        cell = ufl.Cell(kind, geometric_dimension=dimension)
        return ufl.Mesh(ufl.VectorElement("Lagrange", cell, 1))
    return ufl.Mesh(basix.ufl.element("Lagrange", kind, 1, shape=(dimension,)))


def petsc_vector(function: Any) -> Any:
    """The PETSc vector that shares the function's memory. Fetch it once: each call makes a new wrapper."""
    return function.x.petsc_vec if hasattr(function.x, "petsc_vec") else function.vector


def cell_nodes(space: Any, cells: int) -> npt.NDArray[np.int32]:
    """Local node numbers of the first `cells` cells, shape (cells, nodes per cell)."""
    nodes = space.dofmap.list
    flat = nodes.array if hasattr(nodes, "array") else nodes
    return np.asarray(flat, dtype=np.int32).reshape(-1, space.dofmap.dof_layout.num_dofs)[:cells]


def corner_points(mesh: Any, dimension: int, entities: Any) -> npt.NDArray[np.int32]:
    """Places in the geometry of the corners of entities, [entities, corners]."""
    mesh.topology.create_connectivity(dimension, 0)
    mesh.topology.create_connectivity(dimension, mesh.topology.dim)
    inner = getattr(mesh, "_cpp_object", getattr(mesh, "_mesh", mesh))
    entities = np.asarray(entities, dtype=np.int32)
    points = dolfinx.cpp.mesh.entities_to_geometry(inner, dimension, entities, False)
    return np.asarray(points, dtype=np.int32).reshape(len(entities), -1)


def mesh_of_gmsh(model: Any, comm: Any, dimension: int) -> tuple[Any, Any, Any]:
    """Mesh without ghost cells, cell tags and facet tags from Gmsh's model on rank 0."""
    from dolfinx import mesh as dmesh
    from dolfinx.io import gmshio

    none = dmesh.GhostMode.none
    if "partitioner" in inspect.signature(gmshio.model_to_mesh).parameters:
        options: dict[str, Any] = {"gdim": dimension, "partitioner": dmesh.create_cell_partitioner(none)}
        mesh, cells, facets = gmshio.model_to_mesh(model, comm, 0, **options)[:3]
        return mesh, cells, facets
    create = gmshio.create_mesh  # 0.5 leaves no choice of the ghosts
    gmshio.create_mesh = functools.partial(create, ghost_mode=none)
    try:
        mesh, cells, facets = gmshio.model_to_mesh(model, comm, 0, gdim=dimension)
    finally:
        gmshio.create_mesh = create
    return mesh, cells, facets


def settle_geometry(mesh: Any) -> None:
    """Name the spacing of the geometry's nodes before the first form is made.

    FFCx 0.5 does so at the first compilation of a process, which changes the signature of every later form: each
    run would then miss the cache of compiled forms once more.
    """
    scalar = getattr(mesh.ufl_domain().ufl_coordinate_element(), "_sub_element", None)
    if scalar is not None and hasattr(scalar, "_variant"):
        scalar._variant = "equispaced"
