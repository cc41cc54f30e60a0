"""The laws in force: those of laws/, or files of the user's in their place (`replace`)."""

import inspect
import pathlib

import law as law_file
import ufl

BUILT_IN = pathlib.Path(__file__).resolve().parent / "laws"
# of each law: the function that its file defines, and what that may take; a scalar expression comes back
FUNCTIONS = {
    "compliance": ("pressure", ("r",)),
    "friction": ("bound", ("p_n", "speed")),
    "conductance": ("heat_flux", ("r", "p_n", "s")),
}

_files = {}
_loaded = {}


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
            result = ufl.as_ufl(self.function(**taken))
        except Exception as error:
            raise LawError(line_of(error, self.path) or self.line, said(error)) from error
        if result.ufl_shape != () or result.ufl_free_indices != ():
            shape = " x ".join(map(str, result.ufl_shape)) or "free indices"
            raise LawError(self.line, f"{self.function.__name__} is not scalar: it has {shape}")
        return result

    @property
    def is_built_in(self):
        return self.path.parent == BUILT_IN


def replace(files):
    """Take these files, by kind, in place of the built-in laws."""
    _files.update(files)


def loaded(kind):
    """The law of that kind in force."""
    if kind not in _loaded:
        _loaded[kind] = Law(kind, _files.get(kind, BUILT_IN / f"{kind}.py"))
    return _loaded[kind]


def law(kind, **given):
    """The expression of the law in force; what it does not take is not evaluated where it is a function."""
    return loaded(kind)(given)


def constants():
    """The parameters of the laws used so far, by the names under which kernels know them.

    Those of the user's files carry the law before the name, as two files may use one name.
    """
    return {
        name if of_kind.is_built_in else f"{kind}.{name}": value
        for kind, of_kind in _loaded.items()
        for name, value in of_kind.parameters.items()
    }


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
