"""Values that several tables of variations take, and what is said of what changes no field."""

DEFAULT = "the default, written out"
NAME_ONLY = "a name"
FILES_ONLY = "says what is written, not what is computed"
SOLVER_ONLY = "says how the equations are solved, not which"

CONTACT = "contact bottom"
ISOTROPIC = ("material.elasticity.young", "material.elasticity.poisson")
ELASTIC_TENSOR = [[6.0, 2.0, 0.4], [2.0, 4.0, -0.3], [0.4, -0.3, 1.5]]
VISCOUS_TENSOR = [[1.2, 0.2, 0.05], [0.2, 0.8, -0.1], [0.05, -0.1, 0.3]]
CONDUCTOR = [[1.0, 0.25], [0.25, 0.6]]
SINGULAR = [[1.0, 1.0], [1.0, 1.0]]
COUPLING = [[0.4, -0.1], [-0.1, 0.3]]
SPRINGS = [[5.0, 2.0], [2.0, 1.0]]
