"""Results as CalculiX writes them, at the nodes of the input file."""

import re

import numpy as np

#: names of the blocks in a result file, and of what is in them here
_BLOCKS = {"DISP": "displacement", "STRESS": "stress", "ZZSTR": "stress", "NDTEMP": "temperature"}


def read(path):
    """{"nodes": numbers, "points": (n, 3), and of the last step "displacement", "stress" (xx yy zz xy yz zx), "temperature"} of a .frd file."""
    found, block, rows = {}, None, []
    with open(path, encoding="ascii", errors="replace") as file:
        for line in file:
            if line.startswith("    2C"):
                block, rows = "points", []
            elif line.startswith(" -4"):
                block, rows = _BLOCKS.get(line[5:11].strip()), []
            elif block and line.startswith(" -1"):
                values = line[13:].rstrip("\n")
                rows.append([int(line[3:13])] + [float(values[i : i + 12]) for i in range(0, len(values), 12)])
            elif line.startswith(" -3") and block:
                table = np.array(rows)
                if block == "points":
                    found["nodes"] = table[:, 0].astype(int)
                found[block] = table[:, 1] if block == "temperature" else table[:, 1 : 7 if block == "stress" else 4]
                block = None
    return found


def frequencies(path):
    """Hz of the modes in a .dat file."""
    with open(path, encoding="ascii") as file:
        text = file.read()
    return [float(row[2]) for row in re.findall(r"^ +\d+ +(\S+) +(\S+) +(\S+) +\S+ *$", text.split("P A R T I C I P")[0], re.MULTILINE)]
