# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The page of scripts/soak.py."""
import base64
import html
import io
import os
import time


def chart(subjects, column, label):
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 2.6))
    for s in subjects:
        axes.plot([row[0] / 60 for row in s.samples], [row[column] for row in s.samples], label=s.name)
    axes.set_xlabel("time [min]")
    axes.set_ylabel(label)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    axes.set_ylim(bottom=0)
    text = io.BytesIO()
    figure.savefig(text, format="svg", bbox_inches="tight")
    pyplot.close(figure)
    return "data:image/svg+xml;base64," + base64.b64encode(text.getvalue()).decode()


def write_page(subjects, numbers, out):
    """Of what soak.py's leave() keeps."""
    found, counts, missing = numbers["verdicts"], numbers["counts"], numbers["without_gazebo"]
    rows = "".join(f"<tr class={'good' if held else 'bad'}><td>{html.escape(what)}<td>{'holds' if held else 'BROKEN'}<td>{html.escape(figure)}"
                   for what, held, figure in found)
    visitors = "".join(f"<tr><td>{html.escape(k)}<td>{v}" for k, v in sorted(counts.items()))
    left_out = f" Without Gazebo Classic: {missing}." if missing else ""
    charts = "".join(f'<img alt="{label}" src="{chart(subjects, k, label)}">'
                     for k, label in ((1, "resident memory [MB]"), (2, "descriptors"), (3, "threads")))
    (out / "soak.html").write_text(f"""<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>vsasim soak</title>
<style>body{{font:15px/1.5 sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}}table{{border-collapse:collapse;margin:1rem 0}}
td{{padding:.25rem .8rem;border-bottom:1px solid #ddd;vertical-align:top}}.good td:nth-child(2){{color:#0a7d33}}.bad td{{color:#b00020}}
img{{max-width:100%;display:block}}</style>
<h1>Everything at once, {numbers["hours"]:.2f} hours</h1><p>Seed {numbers["seed"]}; {time.strftime("%Y-%m-%d %H:%M", time.gmtime())} UTC;
{os.cpu_count()} processors, load {os.getloadavg()[2]:.1f} in the last quarter of an hour.{html.escape(left_out)}
<table>{rows}</table>{charts}<h2>What came by</h2><table>{visitors}</table></html>
""", encoding="utf-8")
