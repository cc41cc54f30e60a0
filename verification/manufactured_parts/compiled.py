"""The linear forms and error functionals of a study, for FFCx; in_space.py and in_time.py give them to it."""

from typing import Any

import ufl

from manufactured_parts import strong_form as strong
from manufactured_parts.cases import (
    CASES,
    Case,
    Contact,
    anchor,
    displacement,
    foundation_temperature,
    gap,
    temperature,
)

Forms = dict[str, Any]


def quadrature_degree(degree: int) -> int:
    """2 p + 3 for degree p: on tensor cells p + 2 Gauss points a direction, no more than 2 p + 2 takes.

    Errors: the leading part of a squared error is of degree 2 p + 2 (in each variable, on tensor cells), the next one of
    2 p + 3. Both are integrated exactly, so the rule moves an error by O(h^2) of itself. Sources f: with a rule exact to
    degree q, |quadrature error of (f, v)| <= C h^(q+1) |f v|_(q+1) <= C h^(q+2-p) |v|_1, as at most p derivatives fall on
    v and each beyond the first costs 1/h (on tensor cells p in each variable, and the bound by single directions is the
    same). For q = 2 p + 3 that is h^(p+5), far below the p + 1 that is measured.
    """
    return 2 * degree + 3


class Exact:
    """The exact fields of one case on the mesh, those of absent physics None, and the sources that they need."""

    def __init__(self, study: str, case: Case, mesh: Any, t: Any, degree: int) -> None:
        x, self.t, self.case, self.n = (
            ufl.SpatialCoordinate(mesh),
            ufl.variable(t),
            case,
            ufl.FacetNormal(mesh),
        )
        self.x, self.dim = x, len(x)
        self.u = displacement(study, x, self.t, degree) if case.material else None
        self.w = strong.rate(self.u, self.t) if case.material else None
        self.theta = temperature(study, case, x, self.t, degree) if case.heat else None
        self.foundation = foundation_temperature(x, self.t)

    def penetration(self, contact: Contact) -> Any:
        return strong.penetration(self.u, gap(contact, self.u, self.t), self.n)

    def slip(self, contact: Contact) -> Any:
        v = contact.velocity(self.x, self.t) if contact.velocity else None
        return strong.slip_over(None if v is None else ufl.as_vector(v), self.w, self.n)

    def mechanical(self) -> dict[str, Any]:
        """Body force and what acts on a side; with contact, what acts on its side beside the laws."""
        traction = ufl.dot(strong.stress(self.case, self.u, self.w, self.theta), self.n)
        if contact := self.case.contact:
            exerted = strong.contact_traction(contact, self.penetration(contact), self.slip(contact), self.n)
            if contact.spring:
                exerted += strong.spring_traction(contact, self.u, ufl.as_vector(anchor(self.x, self.t)))
            return {"contact_traction": traction - exerted}
        return {
            "body_force": strong.body_force(self.case, self.u, self.t, self.theta),
            "traction": traction,
        }

    def thermal(self) -> dict[str, Any]:
        """The same for the heat: source and flux into the body on a side; with contact, the flux beside its law."""
        inflow = -ufl.dot(strong.heat_flux_vector(self.case, self.theta, self.dim), self.n)
        if contact := self.case.contact:
            r = self.penetration(contact)
            outflow = strong.contact_outflow(contact, self.theta, self.foundation, r)
            if contact.convection:
                outflow += contact.convection * (self.theta - self.foundation)
            if contact.heat_share:
                outflow -= strong.friction_heat(contact, r, self.slip(contact))
            return {"contact_heat_flux": inflow + outflow}
        return {
            "heat_source": strong.heat_source(self.case, self.theta, self.t, self.u, self.dim),
            "heat_flux": inflow,
        }


def forms(study: str, V: Any, Q: Any, mesh: Any, t: Any, u_h: Any, w_h: Any, theta_h: Any) -> Forms:
    """All forms of a study by name: BODY_body_force, ..., BODY_error_gradient of the cases without contact, and
    CASE_contact_traction, CASE_contact_heat_flux of those with it (Case.body says which body is theirs)."""
    degree = Q.ufl_element().degree
    degree = degree() if callable(degree) else degree  # a method before UFL 2023
    rule = {"quadrature_degree": quadrature_degree(degree)}
    dx, ds = ufl.dx(domain=mesh, metadata=rule), ufl.ds(domain=mesh, metadata=rule)
    v, eta = ufl.TestFunction(V), ufl.TestFunction(Q)
    result: Forms = {}

    def add_sources(case: str, sources: dict[str, Any], test: Any) -> None:
        for name, source in sources.items():
            over = dx if name in ("body_force", "heat_source") else ds
            result[f"{case}_{name}"] = ufl.inner(source, test) * over

    def add_error(case: str, name: str, difference: Any) -> None:
        result[f"{case}_error_{name}"] = ufl.inner(difference, difference) * dx

    for name, case in CASES.items():
        exact = Exact(study, case, mesh, t, degree)
        if case.material:
            add_sources(name, exact.mechanical(), v)
        if case.heat:
            add_sources(name, exact.thermal(), eta)
        if case.contact:
            continue
        if case.material:
            add_error(name, "displacement", u_h - exact.u)
            add_error(name, "strain", strong.strain(u_h - exact.u))
            add_error(name, "velocity", w_h - exact.w)
        if case.heat:
            add_error(name, "temperature", theta_h - exact.theta)
            add_error(name, "gradient", ufl.grad(theta_h - exact.theta))
    return result
