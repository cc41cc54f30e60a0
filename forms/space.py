"""Cell and degree of the forms in this folder, chosen once by the generator through `select`.

Every form file starts with `from space import ...`; the same source serves each cell and degree. What differs
between FEniCSx versions is confined to `_element`.
"""

import ufl

# Interval facets: a Gauss rule of m points is exact to degree 2 m - 1, so odd degrees name all rules.
# Rule 0 has its points at the nodes of the facet, which makes `integral(q) / integral(1)` the value at a node.
GAUSS_DEGREES = {"triangle": (1, 3, 5, 7, 9)}
NODE_RULES = {
    ("triangle", 1): (((0.0,), (1.0,)), (1 / 2, 1 / 2)),
    ("triangle", 2): (((0.0,), (1.0,), (0.5,)), (1 / 6, 1 / 6, 2 / 3)),
}


def _element(family, cell, degree, shape=()):
    """Element of the given value shape, for the old (UFL) and the new (Basix) way of naming it."""
    try:
        import basix.ufl

        return basix.ufl.element(family, cell, degree, shape=shape)
    except ImportError:
        if shape:
            return ufl.VectorElement(family, cell, degree, dim=shape[0])
        return ufl.FiniteElement(family, cell, degree)


def select(cell, degree):
    """Define, in this module: mesh, dim, vector space V, scalar space Q, cell-wise stress space S, normal n."""
    names = globals()
    dim = {"triangle": 2}[cell]
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
        _gauss_degrees=GAUSS_DEGREES[cell],
        _node_rule=NODE_RULES[cell, degree],
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
    rules = [
        integrand * ufl.ds(degree, domain=mesh, metadata={"quadrature_degree": degree}) for degree in _gauss_degrees
    ]
    return sum(rules, at_nodes(integrand, subdomain=(0,)))


def at_nodes(integrand, subdomain=()):
    """Integral over facets by the rule at their nodes."""
    points, weights = _node_rule
    metadata = {
        "quadrature_rule": "custom",
        "quadrature_degree": 1,
        "quadrature_points": points,
        "quadrature_weights": weights,
    }
    return integrand * ufl.ds(*subdomain, domain=mesh, metadata=metadata)
