// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A library that a program must not take laws from: WRONG_… says why.
#include "vsa/elastic/law_module.hpp"

namespace {

using namespace vsa::elastic;

[[maybe_unused]] const Law kLaw{
#ifdef WRONG_nameless
    .name = "",
#elif defined(WRONG_taken)
    .name = "two_sinh",
#else
    .name = "refused",
#endif
    .title = "refused",
    .equation = "H = 0",
    .source = "made up",
    .parameters = {},
    .make = [](std::span<const double>) { return std::shared_ptr<const Transmission>(); },
};

#ifdef WRONG_version
constexpr const char* kVersion = "0.0.9";
#else
[[maybe_unused]] constexpr const char* kVersion = VSA_LAW_VERSION;
#endif
#ifdef WRONG_abi
constexpr const char* kAbi = "another compiler's";
#else
[[maybe_unused]] constexpr const char* kAbi = VSA_LAW_ABI;
#endif
#ifdef WRONG_interface
constexpr std::uint32_t kInterface = kLawInterface + 1;
#else
[[maybe_unused]] constexpr std::uint32_t kInterface = kLawInterface;
#endif
#ifdef WRONG_layout
constexpr std::uint64_t kLayout = law_layout() + 1;
#else
[[maybe_unused]] constexpr std::uint64_t kLayout = law_layout();
#endif

[[maybe_unused]] constexpr const Law* kLaws[] = {&kLaw};

}  // namespace

#ifndef WRONG_symbol
extern "C" {
extern const LawModule vsa_law_module;
const LawModule vsa_law_module{kInterface, 1, kLayout, kAbi, kVersion, kLaws};
}
#endif
