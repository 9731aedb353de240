# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

__all__: List[str]

def fit(
    recordings: Sequence[str],
    type: str,
    parameters: str,
    *,
    set: Optional[Mapping[str, Union[bool, int, float, str]]] = None,
    model: str = "bench",
    weights: str = "scatter",
    starts: int = 3,
    seed: int = 1,
    iterations: int = 20,
    global_search: bool = True,
    period_s: float = 38.0,
    amplitude_rad: Optional[float] = None,
    cycles: float = 1.5,
    threads: int = 0,
    load_kg: float = 1.0,
) -> Dict[str, Any]: ...
def read_recording(file: str, type: str, load_kg: float = 1.0) -> Dict[str, Any]: ...
