// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// toml++ and fmt, which Debian packages as shared libraries, compiled into an actuator's FMU from their headers, so that it runs where
// neither is installed. What fmt's library has beside its headers differs from version to version: others than 9 and 10 stay shared.
#define TOML_IMPLEMENTATION
#include <fmt/core.h>
#if FMT_VERSION >= 90000 && FMT_VERSION < 110000
#include <fmt/format-inl.h>
#endif
#include <toml++/toml.h>

#if FMT_VERSION >= 90000 && FMT_VERSION < 110000
FMT_BEGIN_NAMESPACE
namespace detail {
template FMT_API auto thousands_sep_impl<char>(locale_ref) -> thousands_sep_result<char>;
template FMT_API auto decimal_point_impl(locale_ref) -> char;
template FMT_API void buffer<char>::append(const char*, const char*);
template FMT_API auto dragonbox::to_decimal(float x) noexcept -> dragonbox::decimal_fp<float>;
template FMT_API auto dragonbox::to_decimal(double x) noexcept -> dragonbox::decimal_fp<double>;
#if FMT_VERSION < 100000
template FMT_API void vformat_to(buffer<char>&, string_view, basic_format_args<FMT_BUFFER_CONTEXT(char)>, locale_ref);
#else
template FMT_API void vformat_to(buffer<char>&, string_view, vformat_args<>::type, locale_ref);
#endif
}  // namespace detail
FMT_END_NAMESPACE
#endif
