// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vsa {

/// Text as it stands in an XML element or, in double quotes, in an attribute: & < > " as entities, every control character as a
/// space, since XML allows few of them.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace vsa
