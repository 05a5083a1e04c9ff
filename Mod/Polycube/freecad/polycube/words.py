"""Words of the window: translated, and numbers as people read them.

Translations are Qt's files resources/translations/polycube_LANGUAGE.ts, read as they are; resources/translations/update.py brings them up to date.
"""

from functools import lru_cache
from xml.etree import ElementTree

from . import resources


def noop(text):
    """Marks text of a table, or a tuple of texts, for translation; tr() translates it where it is shown."""
    return text


def tr(text):
    """The text in FreeCAD's language, where there is a translation."""
    return _catalogue(_language()).get(text, text)


def _language():
    """As "de", of the window; empty where there is none."""
    import FreeCAD

    if not FreeCAD.GuiUp:
        return ""
    import FreeCADGui

    return FreeCADGui.supportedLocales().get(FreeCADGui.getLocale(), "")


@lru_cache(maxsize=None)
def _catalogue(language):
    """{text: translation} of what is translated into a language."""
    try:
        path = resources.path("translations", "polycube_{}.ts".format(language))
    except FileNotFoundError:
        return {}
    pairs = ((message.findtext("source"), message.find("translation")) for message in ElementTree.parse(path).iter("message"))
    return {source: told.text for source, told in pairs if told is not None and told.text and told.get("type") is None}


def _locale():
    """How the window's spin boxes write numbers, a QLocale; None where there is no window, or where it writes them as programs do."""
    import FreeCAD

    if not FreeCAD.GuiUp:
        return None
    from PySide import QtCore

    locale = QtCore.QLocale()
    return None if locale.language() == QtCore.QLocale.C else locale


def count(number):
    """Digits in groups of three: 53,773, in German 53.773."""
    locale = _locale()
    return locale.toString(int(number)) if locale else "{:,}".format(number)


def decimal(number, digits):
    """With so many digits after the point, in German after the comma."""
    locale = _locale()
    return locale.toString(float(number), "f", digits) if locale else "{:.{}f}".format(number, digits)


def short_count(number):
    """At most four signs, for narrow places: 9957, 12k, 347k, 1.2M."""
    if number < 10000:
        return str(number)
    if number < 999500:
        return "{:.0f}k".format(number / 1000)
    return decimal(number / 1e6, 1) + "M" if number < 99.95e6 else "{:.0f}M".format(number / 1e6)
