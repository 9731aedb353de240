// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
extern "C" int vsa_doctor_absent();
extern "C" int vsa_doctor_nowhere();
extern "C" int vsa_doctor_undefined() { return vsa_doctor_absent() + vsa_doctor_nowhere(); }
