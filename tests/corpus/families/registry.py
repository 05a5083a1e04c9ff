"""What a family of parts is: a function of a Draw, entered under its name by @family or @hard."""

import functools
import random

FAMILIES = {}  # name -> function of a Draw, as a rule parts that a workshop makes every day
HARD = {}      # likewise: parts of the kinds on which hexahedral meshers are known to fail
QUICK_CHECK = set()  # names of those whose faces are not searched for meeting one another


def family(function):
    FAMILIES[function.__name__] = function
    return function


def hard(function=None, *, quick_check=False):
    if function is None:
        return functools.partial(hard, quick_check=quick_check)
    HARD[function.__name__] = function
    if quick_check:
        QUICK_CHECK.add(function.__name__)
    return function


class Draw:
    """The random dimensions of one part. Equal arguments give equal draws, on every machine: a string seeds Python's generator by its SHA-512."""

    def __init__(self, seed, name, index, attempt):
        self.index = index
        self._random = random.Random("{}/{}/{}/{}".format(seed, name, index, attempt))

    def real(self, low, high):
        return self._random.uniform(low, high)

    def length(self, low, high):
        """Millimetres as a drawing gives them, in steps of a tenth."""
        return round(self.real(low, high), 1)

    def count(self, low, high):
        return self._random.randint(low, high)

    def pick(self, *choices):
        return self._random.choice(choices)

    def chance(self, share=0.5):
        return self._random.random() < share
