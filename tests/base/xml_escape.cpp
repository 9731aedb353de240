// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/xml_escape.hpp"

#include <gtest/gtest.h>

namespace {

TEST(XmlEscaped, MakesMarkupAndQuotesTextOnceAndControlCharactersSpaces) {
  EXPECT_EQ(vsa::xml_escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(vsa::xml_escaped("&lt;"), "&amp;lt;") << "what is escaped already is text, too";
  EXPECT_EQ(vsa::xml_escaped("1\x01"
                             "2\n3"),
            "1 2 3");
  EXPECT_EQ(vsa::xml_escaped("δ ± 0.1°"), "δ ± 0.1°");
}

}  // namespace
