"""Options as scripts give them and as FreeCAD properties, made from the engine's table."""

import copy
import math
import re
from numbers import Integral, Real

import FreeCAD

from . import engine
from .errors import InvalidInput, did_you_mean
from .words import noop, tr

#: Names that FreeCAD users know from the Gmsh mesher.
_FAMILIAR = {"size": "CharacteristicLengthMax", "order": "ElementOrder", "per_circle": "MeshSizeFromCurvature"}
#: FreeCAD writes its own element types to the solver.
_NOT_IN_FREECAD = {"element_type"}
_ORDERS = ["1st", "2nd"]
#: Types of options that may be given as text and are numbers.
_NUMBERS = ("double", "int", "bool")
#: A number and a unit: 5 mm, 0.5cm, 2e-3 m
_WITH_UNIT = r"\s*[-+]?[\d.]+(e[-+]?\d+)?\s*[A-Za-z\u00b5\u00b0]+\s*"
_TRUTHS = {"true": True, "false": False}
#: FreeCAD 0.20 has no property for times.
_UNITS = {"mm": "App::PropertyLength", "degrees": "App::PropertyAngle"}
#: What a quantity has to be for an option of this unit; the value that FreeCAD keeps inside is in the option's unit then.
_DIMENSIONS = {
    "mm": (FreeCAD.Units.Length, noop("a length")),
    "degrees": (FreeCAD.Units.Angle, noop("an angle")),
    "s": (FreeCAD.Units.TimeSpan, noop("a time")),
    "": (FreeCAD.Units.Unit(), noop("a plain number")),
}


def table():
    """The engine's options: list of dicts with name, unit, meaning, type, default, min, max, choices, advanced."""
    return copy.deepcopy(engine.description()["options"])


def document_options():
    """The options that a mesh object has as properties."""
    return [option for option in table() if option["name"] not in _NOT_IN_FREECAD]


def property_names():
    """Of all options that a mesh object has; in no time, for it is asked with every change of an object."""
    return {property_name(option) for option in engine.description()["options"] if option["name"] not in _NOT_IN_FREECAD}


def property_name(option):
    """FreeCAD's name of an option: time_limit is TimeLimit."""
    return _FAMILIAR.get(option["name"]) or "".join(word.capitalize() for word in option["name"].split("_"))


def plain(options):
    """The options that are not None, as JSON can hold them: plain numbers in the option's unit, faces by name. InvalidInput for what cannot be read."""
    known = {option["name"]: option for option in table()}
    given = {name: value for name, value in options.items() if value is not None}
    for name in given:
        if name not in known:
            raise InvalidInput(tr("unknown option '{}'{}").format(name, did_you_mean(name, known, tr("; options are "))))
    return {name: _plain(known[name], value) for name, value in given.items()}


def _plain(option, value):
    name, kind = option["name"], option["type"]
    if isinstance(value, str) and kind not in _NUMBERS:
        return value  # as on the command line
    try:
        if kind == "labels":
            return _by_name(name, {face: str(axis) for face, axis in value.items()})
        if kind in ("sizes", "divisions", "bias", "refine"):
            if kind in ("divisions", "bias", "refine") and any(isinstance(what, Integral) for what in value):
                raise TypeError  # a number may be that of a face or of an edge
            return _by_name(name, {what: amount if isinstance(amount, str) and kind == "divisions" else _number(option, amount) for what, amount in value.items()})
        if kind == "faces":
            return [_face(face) for face in value]
        if kind == "frame":
            first, second = value
            directions = [[float(x), float(y), float(z)] for x, y, z in (first, second)]
            if not all(math.isfinite(value) for direction in directions for value in direction):
                raise ValueError
            return directions
        if kind == "string":
            raise TypeError
        return _number(option, value)
    except InvalidInput:
        raise
    except (TypeError, ValueError, AttributeError, OverflowError):
        wanted = {
            "labels": tr('faces with their axes such as {"Face3": "+X"}'),
            "sizes": tr('faces or axes with their sizes such as {"Face3": 0.5, "X": 2}'),
            "refine": tr('faces, edges or vertices with their levels such as {"Face7": 2, "Edge3": 1}'),
            "bias": tr('edges with ratios such as {"Edge4": 2.0}'),
            "divisions": tr('edges or pairs of faces with their elements such as {"Edge4": 6, "Face1-Face2": "3.."}'),
            "faces": tr('faces such as ["Face3", "Face7"]'),
            "frame": tr("a pair of directions such as ((1, 0, 0), (0, 1, 0))"),
            "bool": tr("True or False"),
            "string": tr("one of {}").format(", ".join(option["choices"])),
        }
        raise InvalidInput(tr("{} is not {}").format(name, wanted.get(kind, tr("a number")))) from None


def _by_name(option, values):
    """{"Face3": .5} of {3: .5}. Raises InvalidInput where one face is given by its name and by its number."""
    found = {}
    for what, value in values.items():
        face = _face(what)
        if face in found:
            raise InvalidInput(tr("{}: {} is given twice").format(option, face))
        found[face] = value
    return found


def _face(face):
    """The name of a face that may be given by its number; other names as they are. TypeError for what cannot be one name."""
    if isinstance(face, Integral) and not isinstance(face, bool):
        return "Face{}".format(face)
    if isinstance(face, str) and not set(face) & set("=,"):
        return face.strip()
    raise TypeError


def _number(option, value):
    """A plain number of what may be a quantity or text; TypeError or ValueError for what is no number, InvalidInput for a quantity of another kind."""
    if isinstance(value, FreeCAD.Units.Quantity):
        dimension, meaning = _DIMENSIONS[option["unit"]]
        # without a unit it is a number like any other
        if value.Unit not in (dimension, FreeCAD.Units.Unit()):
            raise InvalidInput(tr("{}: {} is not {}").format(option["name"], value, tr(meaning)))
        value = value.Value
    if option["type"] == "bool":
        value = _TRUTHS.get(value, value) if isinstance(value, str) else value
        if value not in (True, False):
            raise TypeError
        return bool(value)
    if isinstance(value, str):
        value = _from_words(option, value)
        if isinstance(value, FreeCAD.Units.Quantity):
            return _number(option, value)
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise TypeError
    whole = isinstance(value, Integral) or (option["type"] != "double" and float(value).is_integer())
    return int(value) if whole else float(value)


def _from_words(option, text):
    """A number of text, or a quantity of a number with a unit where the option has one, as "5 mm". ValueError for what is neither."""
    try:
        return float(text)
    except ValueError:
        if not option["unit"] or not re.fullmatch(_WITH_UNIT, text):
            raise
    try:
        return FreeCAD.Units.Quantity(text)
    except Exception:  # of its parser, whose kind depends on the version
        raise ValueError(text) from None


def without_defaults(options):
    """The options that are not at their default."""
    defaults = {option["name"]: option["default"] for option in table()}
    return {name: value for name, value in options.items() if value != defaults[name]}


def add_properties(obj):
    """Adds the option properties that the object does not have yet, with their defaults."""
    for option in document_options():
        name, default = property_name(option), option["default"]
        if hasattr(obj, name):
            continue
        group = "Polycube Advanced" if option["advanced"] else "Polycube"
        kind = _property_type(option)
        plain_unit = option["unit"] and option["unit"] not in _UNITS
        obj.addProperty(kind, name, group, option["meaning"] + (" ({})".format(option["unit"]) if plain_unit else ""))
        if option["name"] == "order":
            setattr(obj, name, _ORDERS)
            setattr(obj, name, _ORDERS[default - 1])
        elif option["type"] == "string" and option["choices"]:
            setattr(obj, name, option["choices"])
            setattr(obj, name, default)
        elif option["type"] == "labels":
            setattr(obj, name, [])
        elif option["type"] == "frame":
            setattr(obj, name, "")
        elif option["type"] == "int":
            setattr(obj, name, (default, int(option["min"]), int(min(option["max"], 2**31 - 1)), 1))
        else:
            setattr(obj, name, default)


def _property_type(option):
    if option["name"] == "order" or (option["type"] == "string" and option["choices"]):
        return "App::PropertyEnumeration"
    if option["type"] == "double":
        return _UNITS.get(option["unit"], "App::PropertyFloat")
    kinds = {"int": "App::PropertyIntegerConstraint", "bool": "App::PropertyBool", "labels": "App::PropertyStringList"}
    return kinds.get(option["type"], "App::PropertyString")


def read(obj):
    """The object's options that are not at their default, by engine name."""
    found = {}
    for option in document_options():
        if not hasattr(obj, property_name(option)):
            continue  # of an older document that is being opened
        value = getattr(obj, property_name(option))
        if option["name"] == "order":
            value = _ORDERS.index(value) + 1
        elif option["type"] == "labels":
            value = _labels(value)
        elif option["type"] == "frame":
            value = value.replace(" ", "") or option["default"]
        elif option["type"] == "double":
            value = float(getattr(value, "Value", value))
        if value != option["default"] and value != {}:
            found[option["name"]] = value
    return found


def write(obj, options):
    """Sets the object's properties; options not named go back to their default."""
    for option in document_options():
        value = options.get(option["name"])
        value = option["default"] if value is None else value
        if option["name"] == "order":
            value = _ORDERS[value - 1]
        elif option["type"] == "labels":
            value = ["{}={}".format(face, axis) for face, axis in dict(value or {}).items()]
        elif isinstance(value, (dict, list, tuple)):
            value = as_text(option, value)
        if current(obj, option) != value:
            setattr(obj, property_name(option), value)


def as_text(option, value):
    """The value of an option that is written, as on the command line; text stays what it is."""
    if isinstance(value, str):
        return value
    if option["type"] == "frame":
        return "/".join(",".join(repr(float(number)) for number in axis) for axis in value)
    if isinstance(value, dict):
        return ",".join("{}={}".format(what, value[what]) for what in value)
    return ",".join(value)


def from_text(option, text):
    """The value of an option that is written, as read() has it."""
    text = text.replace(" ", "")
    if option["type"] == "labels":
        return _labels(item for item in text.split(",") if item)
    return text or option["default"]


def current(obj, option):
    """The plain value of an option's property."""
    value = getattr(obj, property_name(option))
    return value.Value if hasattr(value, "Value") else value


def _labels(lines):
    """{"Face3": "+X"} from ["Face3=+X"]."""
    labels = {}
    for line in lines:
        face, separator, axis = line.replace(" ", "").partition("=")
        if not separator:
            raise InvalidInput(tr("label '{}' is not of the form Face3=+X").format(line))
        labels[face] = axis
    return labels
