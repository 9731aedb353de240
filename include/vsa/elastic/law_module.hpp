// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Laws in a shared library of your own, which vsa, the plug-ins for Gazebo and Python load from $VSA_LAW_PATH:
//
//   const vsa::elastic::Law kMine{…};          vsa/elastic/law.hpp
//   VSA_EXPORT_LAWS(&kMine)                    once in the library: &kMine, &kOther, …
//
// C++ objects pass between the library and who loads it, so both must be of one vsasim and of one compiler's ABI; what differs is
// refused when it is loaded (config/law_modules.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>

#include "vsa/elastic/law.hpp"

namespace vsa::elastic {

/// One more with each change of Transmission, of Law, or of what passes between them, that a law compiled before wouldn't survive.
inline constexpr std::uint32_t kLawInterface = 2;

// Words and not variables: of a variable that several libraries have, a process may keep one for all.
/// vsasim's version, as CMakeLists.txt has it.
#define VSA_LAW_VERSION "0.1.0"
#define VSA_LAW_TEXT_OF(number) #number
#define VSA_LAW_TEXT(number) VSA_LAW_TEXT_OF(number)
/// How the compiler lays out objects and names.
#if defined(__GXX_ABI_VERSION) && defined(_GLIBCXX_USE_CXX11_ABI)
#define VSA_LAW_ABI "g++ ABI " VSA_LAW_TEXT(__GXX_ABI_VERSION) ", libstdc++ ABI " VSA_LAW_TEXT(_GLIBCXX_USE_CXX11_ABI)
#else
#define VSA_LAW_ABI "unknown"
#endif

/// The sizes of all that passes, in one number.
[[nodiscard]] constexpr std::uint64_t law_layout() noexcept {
  std::uint64_t out = 0;
  for (const std::size_t size :
       {sizeof(Transmission), sizeof(Response), sizeof(SegmentMean), sizeof(Origin), sizeof(Tangent), sizeof(Law),
        sizeof(LawParameter), sizeof(LawColumn), sizeof(LawFile), sizeof(LawFault), sizeof(std::string)})
    out = 1099511628211U * (out ^ size);
  return out;
}

/// What a library exports as vsa_law_module. `interface` tells whether the rest is as this header has it, so it stays first.
struct LawModule {
  std::uint32_t interface;  ///< kLawInterface of the headers that it was compiled with
  std::uint32_t count;      ///< of laws
  std::uint64_t layout;     ///< law_layout(), likewise
  const char* abi;          ///< VSA_LAW_ABI, likewise
  const char* version;      ///< VSA_LAW_VERSION, likewise
  const Law* const* laws;   ///< `count` of them
};

}  // namespace vsa::elastic

/// Once in a library, with a pointer to each of its laws.
#define VSA_EXPORT_LAWS(...)                                                                  \
  namespace {                                                                                 \
  constexpr const vsa::elastic::Law* vsa_exported_laws[] = {__VA_ARGS__};                     \
  }                                                                                           \
  extern "C" {                                                                                \
  extern __attribute__((visibility("default"))) const vsa::elastic::LawModule vsa_law_module; \
  constinit const vsa::elastic::LawModule vsa_law_module{vsa::elastic::kLawInterface,         \
                                                         std::size(vsa_exported_laws),        \
                                                         vsa::elastic::law_layout(),          \
                                                         VSA_LAW_ABI,                         \
                                                         VSA_LAW_VERSION,                     \
                                                         vsa_exported_laws};                  \
  }
