"""What the reference reads off the package, made readable: constructors and arrays."""
import griffe


class Signatures(griffe.Extension):
    """Shows `__new__` as the constructor that it is, and the alias of arrays as what it stands for."""

    def on_class(self, *, cls, **_):
        if "__new__" in cls.members and "__init__" not in cls.members:
            new = cls.members.pop("__new__")
            new.name, new.returns = "__init__", None
            cls.members["__init__"] = new

    def on_function(self, *, func, **_):
        if str(func.returns) == "_Array":
            func.returns = "NDArray[float64]"

    def on_attribute(self, *, attr, **_):
        if str(attr.annotation) == "_Array":
            attr.annotation = "NDArray[float64]"
