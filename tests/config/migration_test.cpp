// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Elements of the 2021 toolbox and of the plug-in of 2015: every row of docs/howto/migration.md, and every tag of their sources.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "support.hpp"
#include "vsa/config/older_plugin.hpp"

namespace vsa::test {
namespace {

const std::string kHead = R"(<plugin name="vsa::Robot" filename="libvsa-robot.so">)";

std::string actuator(const std::string& type, const std::string& more) {
  return kHead + "<actuator><joint>elbow</joint><type>" + type + "</type>" + more + "</actuator></plugin>";
}

host::RobotConfig parse(const std::string& xml) { return config::parse_plugin(xml, "arm.sdf", shipped()); }

std::vector<Problem> problems_in(const std::string& xml) {
  return problems_of([&] { (void)parse(xml); });
}

std::vector<std::string> code_words(const std::string& cell) {
  std::vector<std::string> words;
  const std::regex code("`([^`]*)`");
  for (std::sregex_iterator at(cell.begin(), cell.end(), code), end; at != end; ++at) words.push_back((*at)[1]);
  return words;
}

struct Row {
  std::vector<std::string> tags;
  std::string type, value, outcome, spelling;
};

/// The table whose header starts with "tag" and "type".
std::vector<Row> rows() {
  std::istringstream lines(read(source_dir() / "docs/howto/migration.md"));
  std::vector<Row> out;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| tag | type", 0) == 0) inside = true;
    if (line.empty()) inside = false;
    if (!inside || line.rfind("| `", 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, '|');) {
      const auto from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
      cells.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
    }
    out.push_back({code_words(cells.at(1)), cells.at(2), cells.at(3), cells.at(4), cells.at(5)});
  }
  return out;
}

std::string tags_of(const Row& row) {
  std::string xml;
  for (const std::string& tag : row.tags) xml += "<" + tag + ">" + row.value + "</" + tag + ">";
  return xml;
}

/// "`key` = value" pairs of the column of the new spelling.
std::vector<config::Override> overrides_of(const Row& row) {
  std::vector<config::Override> out;
  const std::regex pair("`([^`]*)` = ([-0-9.e]+)");
  for (std::sregex_iterator at(row.spelling.begin(), row.spelling.end(), pair), end; at != end; ++at)
    out.push_back({(*at)[1], (*at)[2]});
  return out;
}

/// The springs' torque at a deflected place.
double torque(const device::UnitConfig& unit) {
  const auto& law = *unit.actuator.transmission;
  return law.evaluate({0.4, law.references({0.1, 0.2})}).torque;
}

bool same(const device::UnitConfig& a, const device::UnitConfig& b) {
  return a.actuator.side == b.actuator.side && torque(a) == torque(b);
}

TEST(Migration, EveryTakenRowOfTheTableGivesTheUnitOfTheNewSpelling) {
  int taken = 0;
  for (const Row& row : rows()) {
    if (row.outcome != "taken") continue;
    ++taken;
    const std::string what = row.tags.front() + " = " + row.value;
    const auto problems = problems_in(actuator(row.type, tags_of(row)));
    ASSERT_TRUE(problems.empty()) << what << ": " << text_of(problems);
    const auto expected = shipped().load(row.type, overrides_of(row)).unit;
    EXPECT_TRUE(same(parse(actuator(row.type, tags_of(row))).actuators.at(0).unit, expected)) << what;
    if (!overrides_of(row).empty()) {
      EXPECT_FALSE(same(shipped().load(row.type).unit, expected)) << what << " changes nothing, so the row proves nothing";
    }
  }
  EXPECT_EQ(taken, 11);
}

TEST(Migration, EveryAnsweredRowOfTheTableIsRefusedWithTheNewSpelling) {
  int answered = 0;
  for (const Row& row : rows()) {
    if (row.outcome != "answered") continue;
    ++answered;
    const auto problems = problems_in(actuator(row.type, tags_of(row)));
    ASSERT_EQ(problems.size(), row.tags.size()) << row.tags.front() << ": " << text_of(problems);
    std::string spelling = row.spelling;
    const auto words = code_words(spelling);
    if (!words.empty()) spelling = words.front();
    for (std::size_t i = 0; i < problems.size(); ++i) {
      EXPECT_EQ(problems[i].key, "actuator[1]/" + row.tags[i]);
      EXPECT_NE(problems[i].allowed.find(spelling), std::string::npos) << "no “" << spelling << "” in " << problems[i].text();
      EXPECT_FALSE(problems[i].message.empty());
    }
    for (const config::Override& o : overrides_of(row))
      EXPECT_NE(text_of(problems).find("value=\"" + o.value + "\""), std::string::npos) << text_of(problems);
  }
  EXPECT_EQ(answered, 25);
}

TEST(Migration, TheTableHasEveryTagThatTheOlderSourcesRead) {
  std::set<std::string> told;
  for (const Row& row : rows()) told.insert(row.tags.begin(), row.tags.end());
  std::vector<std::string> tags{"operation_mode", "pub_eltau",  "pub_state",  "sub_ext_tau",  "max_def",
                                "spring_a1",      "spring_k1",  "spring_a2",  "spring_k2",    "spring_k",
                                "spring_a",       "spring_b",   "spring_k_e", "spring_Ks",    "spring_l_0",
                                "spring_L",       "spring_r_t", "stiffness",  "control_type", "namespace"};
  for (const char* motor : {"mot_", "mot_1_", "mot_2_"}) {
    for (const char* of : {"J", "D", "tauMax", "maxVel", "minPos", "maxPos", "tauFric"}) tags.push_back(std::string(motor) + of);
  }
  for (const char* controller : {"ctrl_", "ctrl_1_", "ctrl_2_"}) {
    for (const char* of : {"P", "I", "D"}) tags.push_back(std::string(controller) + of);
  }
  for (const std::string& tag : tags) EXPECT_TRUE(told.count(tag)) << tag;
  EXPECT_EQ(told.size(), tags.size());
}

TEST(Migration, AnElementOfTheToolboxIsAnsweredWithAWholeElementThatWorks) {
  const std::string old = R"(<plugin name="compliant_act_j1" filename="libqbmove_plugin.so"># REQUIRED tags
    <joint>elbow</joint><operation_mode>6</operation_mode><spring_k1>0.0021</spring_k1>
    <mot_1_tauFric>0.6</mot_1_tauFric><mot_2_tauFric>0.6</mot_2_tauFric></plugin>)";
  const auto problems = problems_in(old);
  ASSERT_EQ(problems.size(), 1u) << text_of(problems);
  const std::string& said = problems[0].allowed;
  const std::string fresh = said.substr(0, said.find("</plugin>") + 9);
  const host::RobotConfig robot = parse(fresh);
  EXPECT_EQ(robot.actuators.at(0).joint, "elbow");
  EXPECT_EQ(robot.actuators[0].type, "qbmove_advanced");
  EXPECT_EQ(robot.actuators[0].unit.actuator.side[0].gearbox.friction.coulomb_Nm, 0.6);
  EXPECT_EQ(robot.actuators[0].unit.actuator.side[0].gearbox.friction.presliding_rad, 0.0006);
}

TEST(Migration, TheToolboxsOwnTemplatesGetEveryAnswerAtOnce) {
  std::string inside = "<joint>joint</joint><operation_mode>5</operation_mode><pub_eltau>true</pub_eltau><max_def>0.8</max_def>";
  for (const char* motor : {"1", "2"}) {
    const std::string m = motor;
    inside += "<mot_" + m + "_J>0.0233</mot_" + m + "_J><ctrl_" + m + "_P>125</ctrl_" + m + "_P>";
  }
  const auto problems = problems_in("<plugin name='q' filename='libqbmove_plugin.so'>" + inside + "</plugin>");
  EXPECT_EQ(problems.size(), 6u) << text_of(problems);
  expect_pieces(text_of(problems), {"plugin/operation_mode = 5", "plugin/pub_eltau", "plugin/max_def", "plugin/ctrl_1_P",
                                    "plugin/ctrl_2_P", "<override key=\"drive.inertia_kgm2\" value=\"0.0233\"/>"});
}

TEST(Migration, EachLibraryIsAnsweredWithItsPreset) {
  const auto answer = [](const std::string& file) {
    return text_of(problems_in("<plugin name='x' filename='" + file + "'><joint>j</joint></plugin>"));
  };
  expect_pieces(answer("libsea_plugin.so"), {"<type>sea_example</type>"});
  expect_pieces(answer("libadvanced_plugin.so"), {"<type>qbmove_advanced</type>"});
  expect_pieces(answer("libvsa-robot.so"), {"<joint>j</joint><type>qbmove_advanced</type>"});
  expect_pieces(answer("libbavs_plugin.so"), {"<type>bavs_example</type>"});
  expect_pieces(answer("libawas_ii_plugin.so"), {"<type>awas_2_example</type>"});
}

TEST(Migration, MotorsThatDifferOrComeAloneAreRefused) {
  const auto told = [](const std::string& tags) { return text_of(problems_in(actuator("qbmove_advanced", tags))); };
  expect_pieces(told("<mot_1_J>0.02</mot_1_J>"), {"mot_1_J = 0.02", "mot_2_J is missing"});
  expect_pieces(told("<mot_2_J>0.02</mot_2_J>"), {"mot_2_J = 0.02", "mot_1_J is missing"});
  expect_pieces(told("<mot_1_J>0.02</mot_1_J><mot_2_J>0.03</mot_2_J>"), {"mot_2_J differs"});
  expect_pieces(told("<mot_1_J>0.02</mot_1_J><mot_2_J>heavy</mot_2_J>"), {"mot_2_J = \"heavy\": must be a finite number"});
}

TEST(Migration, ATakenTagIsCheckedLikeTheOverrideItStandsFor) {
  const auto told = [](const std::string& type, const std::string& tags) { return text_of(problems_in(actuator(type, tags))); };
  expect_pieces(told("qbmove_advanced", "<spring_k1>-1</spring_k1>"), {"actuator[1]/spring_k1", "elastic.k1_Nm", "outside"});
  expect_pieces(told("sea_example", "<spring_k1>0.002</spring_k1>"), {"actuator[1]/spring_k1", "elastic.k1_Nm", "unknown key"});
  expect_pieces(told("qbmove_advanced", "<spring_k1>1.6*pow(10,5)</spring_k1>"), {"spring_k1", "must be a finite number"});
  expect_pieces(told("qbmove_advanced", "<spring_k1>0.002</spring_k1><spring_k1>0.003</spring_k1>"), {"more than once"});
  expect_pieces(told("qbmove_advanced", "<spring_k1>0.002</spring_k1><override key='elastic.k1_Nm' value='0.002'/>"),
                {"given twice"});
}

TEST(Migration, MotorValuesOfTheToolboxNeedAPresetWithoutAGearbox) {
  const std::string geared = "<override key='drive.gear_ratio' value='50'/><mot_J>0.02</mot_J>";
  expect_pieces(text_of(problems_in(actuator("sea_example", geared))), {"has a gearbox", "drive.gear_ratio 1"});
}

TEST(Migration, TheShaftOf2015IsTakenAndItsMotorsAreAnswered) {
  const std::string tail = "</joint><type>qbmove_maker_pro_6_1</type></actuator></plugin>";
  const host::RobotConfig shaft = parse(kHead + "<actuator><joint>qbmove_1::output_shaft_joint" + tail);
  Problems none, left, motor;
  config::check_joints(shaft, {"qbmove_1::output_shaft_joint"}, "snake.sdf", none);
  EXPECT_TRUE(none.empty()) << text_of(none.list());
  config::check_joints(shaft, {"qbmove_1::output_shaft_joint", "qbmove_1::motor1_joint", "qbmove_2::motor2_joint"}, "snake.sdf",
                       left);
  ASSERT_EQ(left.list().size(), 1u);
  expect_pieces(text_of(left.list()), {"qbmove_1::motor1_joint", "swing freely"});
  config::check_joints(parse(kHead + "<actuator><joint>motor1_joint" + tail), {"output_shaft_joint", "motor1_joint"}, "m.sdf",
                       motor);
  expect_pieces(text_of(motor.list()), {"is a motor of the plug-in of 2015", "allowed: output_shaft_joint"});
}

TEST(Migration, AMotorsNameOfAnotherModelIsAnyJoint) {
  Problems problems;
  config::check_joints(parse(kHead + "<actuator><joint>motor1_joint</joint><type>sea_example</type></actuator></plugin>"),
                       {"motor1_joint", "motor2_joint"}, "m.sdf", problems);
  EXPECT_TRUE(problems.empty()) << text_of(problems.list());
}

TEST(Migration, ElementsOf2015AreAnsweredWithAWholeElementThatWorks) {
  for (const auto& [old, joint] :
       {std::pair{"<plugin name='plugin_cubebot' filename='build/libqbmove_plugin.so'/>", "output_shaft_joint"},
        std::pair{"<plugin name='p' filename='build/libqbmove_multiple.so'><model_qbmove_3>qbmove_3</model_qbmove_3></plugin>",
                  "qbmove_3::output_shaft_joint"}}) {
    const auto problems = problems_in(old);
    ASSERT_EQ(problems.size(), 1u) << text_of(problems);
    const host::RobotConfig robot = parse(problems[0].allowed.substr(0, problems[0].allowed.find("</plugin>") + 9));
    EXPECT_EQ(robot.actuators.at(0).joint, joint);
    EXPECT_EQ(robot.actuators[0].type, "qbmove_maker_pro_6_1");
  }
}

TEST(Migration, OlderElementsAreToldFromOtherPeoples) {
  EXPECT_TRUE(config::is_older_plugin("<plugin name='a' filename='libsea_plugin.so'><joint>j</joint></plugin>"));
  EXPECT_TRUE(config::is_older_plugin("<plugin name='a' filename='mine.so'><joint>j</joint><mot_J>1</mot_J></plugin>"));
  EXPECT_FALSE(
      config::is_older_plugin("<plugin name='a' filename='libgazebo_ros.so'><joint>j</joint><namespace>n</namespace></plugin>"));
  EXPECT_FALSE(config::is_older_plugin(actuator("sea_example", "<spring_k>10</spring_k>")));
  EXPECT_FALSE(config::is_older_plugin("<plugin"));
}

}  // namespace
}  // namespace vsa::test
