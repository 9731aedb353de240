# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Does identification find what a unit was made of? Units with random springs and frictions, each measured, each fitted.

Every unit goes through the paper's load test at two presets; what its sensors tell is a recording like those of hardware, and fit()
looks for the parameters without knowing them, from the type's own. Run: python3 randomised_identification.py
"""
import csv
import pathlib
import tempfile

import numpy as np
import vsasim

TYPE, PRESETS, SEED, UNITS = "qbmove_maker_pro_6_1", (0.0, 0.3), 4, 3
# What is drawn: a factor on the type's value, at most so much to either side; both springs alike.
SPREAD = {"elastic.k1_Nm": 0.3, "elastic.a1_per_rad": 0.1, "shaft.friction_Nm": 0.5}
TWIN = {"elastic.k1_Nm": "elastic.k2_Nm", "elastic.a1_per_rad": "elastic.a2_per_rad"}

kind = vsasim.ActuatorType.load(TYPE)
random = np.random.default_rng(SEED)


def record(truth, folder):
    """A load test at each preset as CSV files, which tell their preset by their names."""
    done = vsasim.study.characterize(TYPE, experiments=["stiffness"], presets=PRESETS, set=truth)
    files = []
    for preset, entry in zip(PRESETS, done["stiffness"]):
        files.append(pathlib.Path(folder) / f"stiffness_preset_{preset:.4f}rad_samples.csv")
        with open(files[-1], "w", newline="", encoding="utf-8") as out:
            rows = csv.writer(out)
            rows.writerow(["load_torque_Nm", "deflection_rad"])
            for sample in entry["samples"][::20]:
                rows.writerow([sample["measured_load_Nm"], sample["measured_deflection_rad"]])
    return [str(f) for f in files]


parameters = ",".join(key + ("=" + TWIN[key] if key in TWIN else "") for key in SPREAD)
found_all = {key: [] for key in SPREAD}
springs = []
print("unit  " + "".join(f"{key:>28}" for key in SPREAD) + "   (true → found)")
for number in range(1, UNITS + 1):
    factors = {key: 1 + spread * random.uniform(-1, 1) for key, spread in SPREAD.items()}
    truth = {key: kind[key] * factor for key, factor in factors.items()}
    truth.update({TWIN[key]: truth[key] for key in TWIN})
    with tempfile.TemporaryDirectory() as folder:
        fitted = vsasim.identify.fit(
            record(truth, folder), TYPE, parameters, model="quasi-static", weights="equal", starts=1, global_search=False, iterations=15
        )
    line = f"{number:4}  "
    for key, name in zip(SPREAD, parameters.split(",")):
        found = fitted["parameters"][name]["value"]
        found_all[key].append(abs(found / truth[key] - 1))
        line += f"{truth[key]:14.5g} → {found:<11.5g}"
    k, a = (fitted["parameters"][name]["value"] for name in parameters.split(",")[:2])
    springs.append(k * np.sinh(a * 0.5) / (truth["elastic.k1_Nm"] * np.sinh(truth["elastic.a1_per_rad"] * 0.5)) - 1)
    print(line + f"  {1e3 * fitted['rms_rad']:.1f} mrad left")
for key, off in found_all.items():
    print(f"{key}: off by {100 * np.mean(off):.1f} % on average; drawn within ±{100 * SPREAD[key]:.0f} %")
print(f"k and a stand in for each other: the springs' torque at 0.5 rad, k sinh(0.5 a), is off by {100 * np.mean(np.abs(springs)):.1f} %")
