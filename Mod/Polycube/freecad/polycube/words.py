"""Words of the window: translated, and numbers as people read them."""

from PySide import QtCore


def tr(text):
    """The text in FreeCAD's language, where there is a translation."""
    return QtCore.QCoreApplication.translate("Polycube", text)


def count(number):
    """Digits in groups of three: 53,773."""
    return "{:,}".format(number)


def short_count(number):
    """At most four signs, for narrow places: 9957, 12k, 347k, 1.2M."""
    if number < 10000:
        return str(number)
    if number < 999500:
        return "{:.0f}k".format(number / 1000)
    return "{:.1f}M".format(number / 1e6) if number < 99.95e6 else "{:.0f}M".format(number / 1e6)
