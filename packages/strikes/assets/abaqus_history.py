# The histories of an output database as a table. Not run: Abaqus was not at hand.
#
#   abaqus python abaqus_history.py JOB.odb JOB-history.csv
#
# A line of titles, then a line for each time. A title is REGION:VARIABLE, as Abaqus names both.
import sys

from odbAccess import openOdb

database, table = sys.argv[1:3]
odb = openOdb(database, readOnly=True)
step = odb.steps.values()[0]
columns = []
for region in step.historyRegions.values():
    for name, output in region.historyOutputs.items():
        columns.append((region.name + ":" + name, dict(output.data)))
times = sorted(set(time for _, data in columns for time in data))
with open(table, "w") as out:
    out.write(",".join(["time"] + [title.replace(",", " ") for title, _ in columns]) + "\n")
    for time in times:
        out.write(",".join([repr(time)] + [repr(data[time]) if time in data else "" for _, data in columns]) + "\n")
odb.close()
