"""The laws in force: those of laws/, or files of the user's in their place (`replace`)."""

import inspect
import pathlib

import law as law_file
import space
import ufl

BUILT_IN = pathlib.Path(__file__).resolve().parent / "laws"
# of each law: the function that its file defines, and what that may take
FUNCTIONS = {
    "compliance": ("pressure", ("r",)),
    "friction": ("bound", ("p_n", "speed")),
    "conductance": ("heat_flux", ("r", "p_n", "s")),
    "elasticity": ("stress", ("strain", "x")),
    "viscosity": ("stress", ("strain_rate", "x")),
    "source": ("source", ("x", "t")),
    "body_force": ("force", ("x", "t")),
}
TENSORS, LOADS = ("elasticity", "viscosity"), ("source", "body_force")

_files = {}
_loaded = {}
_plane_strain = False


class LawError(Exception):
    """What is wrong with a law file, and in which line (0: in none)."""

    def __init__(self, line, message):
        super().__init__(message)
        self.line = line


class Law:
    """A law file that was read: its function, what that takes, and its parameters by their names in the file."""

    def __init__(self, kind, path):
        name, possible = FUNCTIONS[kind]
        self.kind, self.path = kind, pathlib.Path(path)
        namespace = _executed(self.path)
        function = namespace.get(name)
        if not inspect.isfunction(function):
            raise LawError(0, f"defines no function {name}({', '.join(possible)})")
        self.function, self.line = function, function.__code__.co_firstlineno
        self.title = (namespace.get("__doc__") or "").strip().split("\n")[0]
        self.arguments = tuple(inspect.signature(function).parameters)
        for argument in self.arguments:
            if argument not in possible:
                raise LawError(
                    self.line, f"{name} takes {argument!r}; expected some of {', '.join(possible)}"
                )
        self.parameters = {
            name: value for name, value in namespace.items() if law_file.declared_as(value) is not None
        }
        keys = [law_file.declared_as(value)["key"] for value in self.parameters.values()]
        for key in keys:
            if keys.count(key) > 1:
                raise LawError(0, f"two parameters have the key {key!r}")

    def __call__(self, given):
        """The law's expression of what it takes among `given`: expressions by name, or functions that make them."""
        taken = {name: given[name] for name in self.arguments}
        taken = {name: made() if inspect.isfunction(made) else made for name, made in taken.items()}
        try:
            result = self.function(**taken)
            result = ufl.as_vector(result) if isinstance(result, (tuple, list)) else ufl.as_ufl(result)
        except Exception as error:
            raise LawError(line_of(error, self.path) or self.line, said(error)) from error
        if result.ufl_shape != self.shape or result.ufl_free_indices != ():
            found = " x ".join(map(str, result.ufl_shape)) if result.ufl_shape else "a scalar"
            found = "free indices" if result.ufl_free_indices else found
            expected = " x ".join(map(str, self.shape)) or "scalar"
            raise LawError(self.line, f"{self.function.__name__} is not {expected}: it has {found}")
        return result

    @property
    def shape(self):
        """Of what the function gives: a tensor of stress, which in plane strain has all its components, a force, a number."""
        if self.kind in TENSORS:
            return 2 * (strain_size(),)
        return (space.dim,) if self.kind == "body_force" else ()

    @property
    def is_built_in(self):
        return self.path.parent == BUILT_IN


def replace(files, plane_strain=False):
    """Take these files, by kind, in place of the built-in laws; a body in 2D is in plane strain or in plane stress."""
    global _plane_strain
    _files.update(files)
    _loaded.clear()
    _plane_strain = plane_strain


def loaded(kind):
    """The law of that kind in force."""
    if kind not in _loaded:
        _loaded[kind] = Law(kind, _files.get(kind, BUILT_IN / f"{kind}.py"))
    return _loaded[kind]


def law(kind, **given):
    """The expression of the law in force; what it does not take is not evaluated where it is a function."""
    return loaded(kind)(given)


def is_own(kind):
    """Whether a file of the user's is in force."""
    return kind in _files


def dx_of(*kinds):
    """Integration over cells by the rule of the user's laws, if one of these is; else what the integrand asks for."""
    return space.over_cells if any(map(is_own, kinds)) else ufl.dx


def strain_size():
    """Rows of the strain that a law is given: in plane strain it has those out of the plane, which are 0."""
    return 3 if space.dim == 3 or _plane_strain else 2


def tensor(kind):
    """E or Visc as Voigt matrix, and its row of the stress out of the plane: constants, or the law of a file."""
    if not is_own(kind):
        size = space.voigt_size
        return ufl.Constant(space.mesh, shape=(size, size)), ufl.Constant(space.mesh, shape=(size,))
    rows = stress_rows(kind)
    if space.dim == 3:
        return ufl.as_matrix(rows), None
    return ufl.as_matrix([rows[0], rows[1], rows[5]]), ufl.as_vector(rows[2])


def stress_rows(kind):
    """What the law gives of unit strains, in Voigt's order with engineering shear: [xx, yy, zz, yz, xz, xy][strains].

    In plane stress there is nothing out of the plane.
    """
    size, columns = strain_size(), unit_stresses(kind)
    return [
        [(stress[i, j] + stress[j, i]) / 2 if max(i, j) < size else ufl.as_ufl(0.0) for stress in columns]
        for i, j in _pairs(3)
    ]


def unit_stresses(kind):
    """The stress of each unit strain."""
    size, the_law = strain_size(), loaded(kind)
    return [
        the_law({FUNCTIONS[kind][1][0]: _unit_strain(pair, size), "x": space.x}) for pair in _pairs(space.dim)
    ]


def _pairs(dim):
    shear = ((1, 2), (0, 2), (0, 1)) if dim == 3 else ((0, 1),)
    return (*((i, i) for i in range(dim)), *shear)


def _unit_strain(pair, size):
    half = 1.0 if pair[0] == pair[1] else 0.5
    return ufl.as_matrix(
        [[half if sorted((i, j)) == sorted(pair) else 0.0 for j in range(size)] for i in range(size)]
    )


def constants():
    """The parameters of the laws used so far, by the names under which kernels know them.

    Those of the user's files carry the law before the name, as two files may use one name.
    """
    return {
        name if of_kind.is_built_in else f"{kind}.{name}": value
        for kind, of_kind in _loaded.items()
        for name, value in of_kind.parameters.items()
    }


def expect_given(the_law, value, given):
    """Refuse a law whose value has something in it that is neither among `given` nor a parameter of its own."""
    known = {*given, *the_law.parameters.values()}
    kinds = (ufl.core.terminal.FormArgument, ufl.Constant, ufl.geometry.GeometricQuantity)
    for kind in kinds:
        for terminal in ufl.algorithms.extract_type(value, kind):
            if terminal not in known:
                name = the_law.function.__name__
                raise LawError(the_law.line, f"{name} contains {terminal}, which it was not given")


def said(error):
    """The message of an exception in one line."""
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def line_of(error, path):
    """The line of that file in which an exception arose; 0 where it arose elsewhere."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno or 0
    line, trace = 0, error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            line = trace.tb_lineno
        trace = trace.tb_next
    return line


def _executed(path):
    namespace = {"__name__": path.stem}
    try:
        exec(compile(path.read_bytes(), str(path), "exec"), namespace)
    except OSError as error:
        raise LawError(0, f"cannot be read: {error.strerror}") from error
    except Exception as error:
        said_of = error.msg if isinstance(error, SyntaxError) else said(error)
        raise LawError(line_of(error, path), said_of) from error
    return namespace
