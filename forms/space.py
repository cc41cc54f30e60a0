"""Cell and degree of the forms in this folder, chosen once by the generator through `select`.

Every form file starts with `from space import ...`; the same source serves each cell and degree. What differs
between FEniCSx versions is confined to `_element`.
"""

import ufl

# Gauss rules on facets by the degree to which they are exact. On intervals and quadrilaterals m points a direction
# are exact to degree 2 m - 1, so odd degrees name all rules; on triangles each degree has a rule of its own.
_ODD, _ALL = (1, 3, 5, 7, 9), (1, 2, 3, 4, 5, 6, 7, 8, 9)
GAUSS_DEGREES = {"triangle": _ODD, "quadrilateral": _ODD, "tetrahedron": _ALL, "hexahedron": _ODD}


def _trapezoid(degree):
    """Points and weights of the trapezoid rule or of Simpson's on the interval: ends, then the midpoint."""
    if degree == 1:
        return ((0.0,), (1.0,)), (1 / 2, 1 / 2)
    return ((0.0,), (1.0,), (0.5,)), (1 / 6, 1 / 6, 2 / 3)


def _product(rule):
    """The rule on the square that is the product of one on the interval."""
    points, weights = rule
    pairs = [(i, j) for i in range(len(weights)) for j in range(len(weights))]
    return tuple(points[i] + points[j] for i, j in pairs), tuple(weights[i] * weights[j] for i, j in pairs)


_CORNERS = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
_MIDPOINTS = ((0.5, 0.5), (0.0, 0.5), (0.5, 0.0))


def _vertex_rule(cell, degree):
    """Rule 0, at nodes of the facet: exact for the functions of the space, without negative weights.

    On triangles of degree 2 the weights of the corners vanish, so that only the midpoints of the edges remain.
    """
    if cell == "tetrahedron":
        return (_CORNERS if degree == 1 else _MIDPOINTS), (1 / 6, 1 / 6, 1 / 6)
    return _product(_trapezoid(degree)) if cell == "hexahedron" else _trapezoid(degree)


def _nodal_rule(cell, degree):
    """Positive weights at all nodes of the facet, which makes `integral(f q) / integral(q)` the value of f there."""
    if cell == "tetrahedron" and degree == 2:
        return _CORNERS + _MIDPOINTS, 6 * (1 / 12,)
    return _vertex_rule(cell, degree)


def _element(family, cell, degree, shape=()):
    """Element of the given value shape, for the old (UFL) and the new (Basix) way of naming it."""
    try:
        import basix.ufl

        return basix.ufl.element(family, cell, degree, shape=shape)
    except ImportError:
        if shape:
            return ufl.VectorElement(family, cell, degree, dim=shape[0])
        return ufl.FiniteElement(family, cell, degree)


def _quadrature_element(cell, degree, size):
    """`size` values at each point of the rule."""
    try:
        import basix.ufl

        return basix.ufl.quadrature_element(cell, (size,), degree=degree)
    except ImportError:
        return ufl.VectorElement("Quadrature", cell, degree, dim=size, quad_scheme="default")


def select(cell, degree):
    """Define, in this module: mesh, dim, vector space V, scalar space Q, cell-wise stress space S, normal n, place x."""
    names = globals()
    dim = {"triangle": 2, "quadrilateral": 2, "tetrahedron": 3, "hexahedron": 3}[cell]
    mesh = ufl.Mesh(_element("Lagrange", cell, 1, (dim,)))
    constant_family = "DG"
    names.update(
        dim=dim,
        voigt_size=dim * (dim + 1) // 2,
        mesh=mesh,
        V=ufl.FunctionSpace(mesh, _element("Lagrange", cell, degree, (dim,))),
        Q=ufl.FunctionSpace(mesh, _element("Lagrange", cell, degree)),
        S=ufl.FunctionSpace(mesh, _element(constant_family, cell, 0, (6,))),
        D=ufl.FunctionSpace(mesh, _element(constant_family, cell, 0)),
        n=ufl.FacetNormal(mesh),
        x=ufl.SpatialCoordinate(mesh),
        _gauss_degrees=GAUSS_DEGREES[cell],
        _vertices=_custom(*_vertex_rule(cell, degree)),
        _nodes=_custom(*_nodal_rule(cell, degree)),
        # degree + 1 Gauss points a direction on cells whose geometry is not affine; None: what the integrand asks for
        _full=2 * degree + 1 if cell in ("quadrilateral", "hexahedron") else None,
    )
    # laws of files vary within cells: the same there, on simplices a rule of even degree, whose weights are positive
    rule = _full or 2 * degree + 2
    names.update(
        over_cells=ufl.dx(metadata={"quadrature_degree": rule}),
        points=lambda size: ufl.FunctionSpace(mesh, _quadrature_element(cell, rule, size)),
    )


def voigt(tensor):
    """Symmetric 2-tensor as the Voigt vector with engineering shear: (xx, yy, 2 xy), or (xx, yy, zz, 2 yz, 2 xz, 2 xy)."""
    if dim == 2:
        return ufl.as_vector([tensor[0, 0], tensor[1, 1], 2 * tensor[0, 1]])
    shear = [2 * tensor[1, 2], 2 * tensor[0, 2], 2 * tensor[0, 1]]
    return ufl.as_vector([tensor[i, i] for i in range(3)] + shear)


def strain(u):
    """eps(u) = (grad u + grad u^T) / 2."""
    return ufl.sym(ufl.grad(u))


def tangential(w):
    """w_t = w - (w.n) n."""
    return w - ufl.dot(w, n) * n


def positive_part(r):
    """r_+, with derivative 1 at r = 0: contact that just touches counts as closed."""
    return ufl.conditional(ufl.ge(r, 0), r, 0)


def over_contact(integrand):
    """Integral over contact facets, once for every rule a scene may ask for; the subdomain id is the rule's name."""
    rules = {degree: {"quadrature_degree": degree} for degree in _gauss_degrees} | {0: _vertices}
    return sum(integrand * ufl.ds(rule, domain=mesh, metadata=metadata) for rule, metadata in rules.items())


def at_nodes(integrand):
    """Integral over facets by the rule at all their nodes."""
    return integrand * ufl.ds(domain=mesh, metadata=_nodes)


def _custom(points, weights):
    """Metadata of the rule with these points, in reference coordinates of the facet."""
    return {
        "quadrature_rule": "custom",
        "quadrature_degree": 1,
        "quadrature_points": points,
        "quadrature_weights": weights,
    }


def completed(form):
    """The form with a rule named for the integrals that leave theirs open, where the geometry is not affine."""
    if _full is None:
        return form
    named = [
        integral
        if "quadrature_degree" in integral.metadata()
        else integral.reconstruct(metadata={**integral.metadata(), "quadrature_degree": _full})
        for integral in form.integrals()
    ]
    return ufl.Form(named)
