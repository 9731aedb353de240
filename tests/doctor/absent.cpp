// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
extern "C" int vsa_doctor_absent() { return 1; }
