# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Union

import numpy.typing as npt

__all__: List[str]

def characterize(
    type: str,
    *,
    experiments: Sequence[str] = (),
    presets: Optional[npt.ArrayLike] = None,
    period_s: Optional[float] = None,
    amplitude_rad: Optional[float] = None,
    cycles: Optional[int] = None,
    set: Optional[Mapping[str, Union[bool, int, float, str]]] = None,
    step_s: Optional[float] = None,
    progress: Optional[Callable[[float, float, float], Optional[bool]]] = None,
    threads: int = 0,
) -> Optional[Dict[str, Any]]: ...
