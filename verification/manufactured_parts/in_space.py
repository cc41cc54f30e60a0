"""Sources and errors of the manufactured solutions of the study in space (cases.py), named as compiled.py says"""

from space import Q, V, mesh
from ufl import Coefficient, Constant

from manufactured_parts.compiled import forms

t = Constant(mesh)
u_h, w_h, theta_h = Coefficient(V), Coefficient(V), Coefficient(Q)

globals().update(forms("space", V, Q, mesh, t, u_h, w_h, theta_h))
