// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/page/page.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "record/scratch.hpp"
#include "vsa/errors.hpp"
#include "vsa/output_file.hpp"
#include "vsa/page/json.hpp"

namespace vsa::page {
namespace {

namespace fs = std::filesystem;

TEST(JsonString, NeverLeavesTheScriptElementItStandsIn) {
  EXPECT_EQ(json_string("</script><!--&"), R"("\u003c/script\u003e\u003c!--\u0026")");
  EXPECT_EQ(json_string("a\"b\\c\n\x01"), R"("a\"b\\c\n\u0001")");
  EXPECT_EQ(json_string("\u2028\u2029"), R"("\u2028\u2029")");
}

TEST(JsonString, KeepsUtf8AndReplacesWhatIsNone) {
  EXPECT_EQ(json_string("Σ \U0001F40D"), "\"Σ \U0001F40D\"");
  const std::string bad = "\uFFFD";
  for (const std::string& piece :
       {std::string("\xff"), std::string("\xc0\xaf"), std::string("\xed\xa0\x80"), std::string("\xe2\x82")}) {
    const std::string out = well_formed("a" + piece + "b");
    ASSERT_GE(out.size(), 2 + bad.size());
    EXPECT_EQ(out.substr(0, 1 + bad.size()), "a" + bad);
    EXPECT_EQ(out.back(), 'b');
    EXPECT_EQ(well_formed(out), out);
    EXPECT_EQ(json_string("a" + piece + "b"), '"' + out + '"');
  }
}

std::string refusal(std::string_view text) {
  try {
    (void)read_json(text, "f.json", "an object");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ReadJson, TellsLineAndKeyOfWhatIsGivenTwiceInOneObject) {
  EXPECT_EQ(refusal("{\n\"a\": 1,\n\"b\": {\"a\": 2},\n\"a\": 3}"),
            "f.json:4: a: is given twice in one object (allowed: an object)");
  EXPECT_EQ(refusal("[{\"a\": 1}, {\"a\": 1, \"b\": [{\"b\": 1}]}]"), "");
  EXPECT_EQ(refusal("{\"x\": {\"\\u0061\": 1, \"a\": 2}}"), "f.json:1: a: is given twice in one object (allowed: an object)");
  EXPECT_EQ(refusal("{\n\n\"a\": }"), "f.json:3: isn't JSON (allowed: an object)");
  EXPECT_EQ(refusal(""), "f.json:1: isn't JSON (allowed: an object)");
  EXPECT_EQ(read_json("{\"b\": [1, 2.5], \"a\": null}", "", "").dump(), R"({"b":[1,2.5],"a":null})");
}

TEST(Number, ReadsBackAndIsNullWhereJsonHasNone) {
  EXPECT_EQ(text(number(0.1)), "0.1");
  EXPECT_EQ(text(number(0.1f)), "0.1");
  EXPECT_EQ(text(number(-3.0)), "-3");
  EXPECT_EQ(text(number(1e300)), "1e+300");
  EXPECT_EQ(text(number(2.0 / 3, 6)), "0.666667");
  EXPECT_EQ(text(number(std::numeric_limits<double>::infinity())), "null");
  EXPECT_EQ(text(number(std::numeric_limits<float>::quiet_NaN())), "null");
}

TEST(Base64, IsTheStandardOneOverLittleEndianNumbers) {
  EXPECT_EQ(base64({}), "");
  EXPECT_EQ(base64({1.0f}), "AACAPw==");
  EXPECT_EQ(base64({1.0f, -2.0f}), "AACAPwAAAMA=");
  EXPECT_EQ(base64({1.0f, -2.0f, 0.5f}), "AACAPwAAAMAAAAA/");
  EXPECT_EQ(base64_wide({1.0, -2.0}), "AAAAAAAA8D8AAAAAAAAAwA==");
}

TEST(Page, IsTheTemplateWithTheDataInPlaceOfTheMarker) {
  const record::Scratch dir;
  write(dir.path() / "replay.html", "<script>@VSA_PAGE_DATA@</script>", "{\"a\":1}");
  EXPECT_EQ(record::slurp(dir.path() / "replay.html"), "<script>{\"a\":1}</script>");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir.path()), {}), 1) << "nothing is left beside it";
}

TEST(Page, ThatCantBeWrittenIsAFailureWithItsName) {
  const record::Scratch dir;
  fs::create_symlink("/dev/full", dir.path() / "replay.html");
  const std::string message = record::message_of<OutputError>([&] { write(dir.path() / "replay.html", "@VSA_PAGE_DATA@", "{}"); });
  EXPECT_NE(message.find("No space left on device"), std::string::npos) << message;
  EXPECT_NE(message.find((dir.path() / "replay.html").string()), std::string::npos) << message;
}

TEST(Page, RefusesATemplateThatIsMissingOrNone) {
  const record::Scratch dir;
  const std::string missing = record::message_of<InputError>([&] { (void)read_template(dir.path() / "no.html"); });
  EXPECT_NE(missing.find("No such file or directory"), std::string::npos) << missing;
  record::spew(dir.path() / "bad.html", "<html>");
  const std::string bad = record::message_of<InputError>([&] { (void)read_template(dir.path() / "bad.html"); });
  EXPECT_NE(bad.find("it must hold @VSA_PAGE_DATA@ once"), std::string::npos) << bad;
}

}  // namespace
}  // namespace vsa::page
