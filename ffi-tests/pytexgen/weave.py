"""A plain weave by TexGen as a dry-fibre mesh for Abaqus: yarns a family, pitch, width, height, points of a section, refined or not
(0 or 1), and the input file, which gets its .ori and .eld beside it."""

import sys

from pytexgen.Core import CSimulationAbaqus, CTextileWeave2D

count, pitch, width, height, points, refine = (float(x) for x in sys.argv[1:7])
count = int(count)
textile = CTextileWeave2D(count, count, pitch, 2.0 * height, bool(refine), True)
for i in range(count):
    for j in range(count):
        if (i + j) % 2 == 0:
            textile.SwapPosition(i, j)
textile.SetYarnWidths(width)
textile.SetYarnHeights(height)
textile.SetResolution(int(points))
textile.AssignDefaultDomain()
simulation = CSimulationAbaqus()
simulation.SetIncludePlates(False)
assert simulation.CreateAbaqusInputFile(textile, sys.argv[7], True, 0, False, 1e-7)
