# %% [markdown]
# # Reading a report of Lightbench
#
# A report is a folder. This file reads `report.json` and the CSV tables beside it. It is a script and
# a notebook: editors that know `# %%` cells run it piece by piece, and `jupytext --to notebook`
# makes an `.ipynb` file of it. What follows needs Python alone; the last cells use pandas or polars
# where one is installed.

# %%
import csv
import json
import statistics
import sys
from pathlib import Path

SCHEMA = 2
folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")

# %% [markdown]
# ## The JSON file: everything but the pixels

# %%
study = json.loads((folder / "report.json").read_text(encoding="utf-8"))
if study["schema"] != SCHEMA:
    raise SystemExit(f"{folder}/report.json has schema {study['schema']}; this reads schema {SCHEMA}")

for point in study["points"]:
    for pipeline in point["comparison"]["pipelines"]:
        times = pipeline["frame_gpu_ms"] or pipeline["frame_cpu_ms"]
        print(point["key"], pipeline["name"], f"{statistics.median(times):.3f} ms")

# %% [markdown]
# ## The CSV tables: one row a frame, with the point and the process
#
# The median of each process, and of those the median: processes differ more than frames do.

# %%
with open(folder / "frames.csv", newline="", encoding="utf-8") as file:
    frames = list(csv.DictReader(file))

by_process = {}
for row in frames:
    if row["gpu_ms"]:
        key = (row["point"], row["pipeline"], row["process"])
        by_process.setdefault(key, []).append(float(row["gpu_ms"]))

medians = {}
for (point, pipeline, _), times in by_process.items():
    medians.setdefault((point, pipeline), []).append(statistics.median(times))
for (point, pipeline), values in medians.items():
    print(f"{point} {pipeline}: median of {len(values)} processes {statistics.median(values):.3f} ms")

# %% [markdown]
# ## The same with pandas, or with polars

# %%
try:
    import pandas
except ImportError:
    pandas = None
try:
    import polars
except ImportError:
    polars = None

if pandas is not None:
    table = pandas.read_csv(folder / "frames.csv")
    inner = table.groupby(["point", "pipeline", "process"])["gpu_ms"].median()
    print(inner.groupby(["point", "pipeline"]).median().unstack("pipeline"))
elif polars is not None:
    table = polars.read_csv(folder / "frames.csv")
    inner = table.group_by(["point", "pipeline", "process"]).agg(polars.col("gpu_ms").median())
    print(inner.group_by(["point", "pipeline"]).agg(polars.col("gpu_ms").median()))
else:
    print("Neither pandas nor polars is installed.")
