// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in element: its grammar, what stands where nothing is given, and every way to get it wrong.
#include <gtest/gtest.h>

#include "support.hpp"

namespace vsa::test {
namespace {

const std::string kHead = R"(<plugin name="vsa::Robot" filename="libvsa-robot.so">)";
const std::string kElbow = "<actuator><joint>elbow</joint><type>sea_example</type></actuator>";

std::string plugin(const std::string& inside) { return kHead + inside + "</plugin>"; }

/// An actuator of the maker pro on joint `joint` with more elements.
std::string maker_pro(const std::string& joint, const std::string& more = "", const std::string& attributes = "") {
  return "<actuator" + attributes + "><joint>" + joint + "</joint><type>qbmove_maker_pro_6_1</type>" + more + "</actuator>";
}

host::RobotConfig parse(const std::string& xml) { return config::parse_plugin(xml, "arm.sdf", shipped()); }

std::vector<Problem> problems_in(const std::string& xml) {
  return problems_of([&] { (void)parse(xml); });
}

TEST(Plugin, TheFullExampleOfTheDocumentationIsRead) {
  const std::string text = read(source_dir() / "docs/reference/config.md");
  const std::size_t from = text.find("<plugin"), to = text.find("</plugin>", from);
  ASSERT_NE(to, std::string::npos);
  const host::RobotConfig robot = parse(text.substr(from, to + 9 - from));
  ASSERT_EQ(robot.actuators.size(), 2u);
  ASSERT_EQ(robot.buses.size(), 1u);
  const host::ActuatorConfig& shoulder = robot.actuators[0];
  EXPECT_EQ(shoulder.name, "shoulder");
  EXPECT_EQ(shoulder.joint, "module_1::shaft");
  EXPECT_EQ(shoulder.type, "qbmove_maker_pro_6_1");
  EXPECT_EQ(shoulder.id, 1);
  EXPECT_EQ(shoulder.initial_preset, 0.2);
  EXPECT_EQ(shoulder.unit.actuator.side[0].gearbox.friction.coulomb_Nm, 0.7);
  EXPECT_EQ(robot.actuators[1].name, "module_2::shaft");
  EXPECT_EQ(robot.actuators[1].id, 2);
  EXPECT_EQ(robot.actuators[1].unit.actuator.side[0].gearbox, shipped().load("qbmove_maker_pro_6_1").unit.actuator.side[0].gearbox);
  EXPECT_EQ(robot.buses[0].name, "arm");
  EXPECT_EQ(robot.buses[0].baud_Hz, 2e6);
  EXPECT_FALSE(robot.buses[0].cycle_s.has_value());
  EXPECT_EQ(robot.state_rate_Hz, 100);
}

TEST(Plugin, TheOldSpellingOfATypeIsUnderstoodAndToldOnce) {
  const std::string old = "<actuator><joint>elbow</joint><preset>sea_example</preset></actuator>";
  const std::string another = "<actuator><joint>wrist</joint><preset>sea_example</preset></actuator>";
  const host::RobotConfig robot = parse(plugin(old + another));
  EXPECT_EQ(robot.actuators.at(1).type, "sea_example");
  ASSERT_EQ(robot.notices.size(), 1u);
  expect_pieces(robot.notices[0], {"<preset> is called <type> now"});
  EXPECT_TRUE(parse(plugin(kElbow)).notices.empty());
  const auto both =
      problems_in(plugin("<actuator><joint>elbow</joint><type>sea_example</type><preset>sea_example</preset></actuator>"));
  expect_pieces(text_of(both), {"actuator[1]/preset", "is an old name of type"});
  expect_pieces(text_of(problems_in(plugin("<actuator joint='elbow' preset='sea_example'/>"))),
                {"actuator[1]@preset", "<type>sea_example</type>", "<joint>elbow</joint>"});
}

TEST(Plugin, AReplacementPutsAnotherActuatorOnEveryJoint) {
  const std::string xml = plugin(maker_pro("a",
                                           "<initial equilibrium_rad='0.1' preset_rad='0.2'/>"
                                           "<override key='drive.friction_Nm' value='0.7'/>") +
                                 kElbow);
  const config::Replacement other{"qbmove_advanced", {{"shaft.friction_Nm", "0.02"}}};
  const host::RobotConfig robot = config::parse_plugin(xml, "arm.sdf", shipped(), other);
  const device::UnitConfig expected = shipped().load("qbmove_advanced", other.overrides).unit;
  for (const host::ActuatorConfig& a : robot.actuators) {
    EXPECT_EQ(a.type, "qbmove_advanced");
    EXPECT_EQ(a.unit.actuator.side[0].gearbox, expected.actuator.side[0].gearbox)
        << "the element's override belongs to its own type";
    EXPECT_EQ(a.unit.actuator.shaft_friction.coulomb_Nm, 0.02);
  }
  EXPECT_EQ(robot.actuators[0].initial_preset, 0.2);
  EXPECT_EQ(robot.actuators[0].initial_equilibrium_rad, 0.1);
}

TEST(Plugin, ReplacingValuesKeepThePresetAndWinOverTheElements) {
  const std::string xml = plugin(maker_pro("a",
                                           "<override key='drive.friction_Nm' value='0.7'/>"
                                           "<override key='shaft.friction_Nm' value='0.02'/>"));
  const auto robot = config::parse_plugin(xml, "arm.sdf", shipped(), {std::nullopt, {{"drive.friction_Nm", "0.4"}}});
  EXPECT_EQ(robot.actuators[0].type, "qbmove_maker_pro_6_1");
  EXPECT_EQ(robot.actuators[0].unit.actuator.side[0].gearbox.friction.coulomb_Nm, 0.4);
  EXPECT_EQ(robot.actuators[0].unit.actuator.shaft_friction.coulomb_Nm, 0.02);
}

TEST(Plugin, AnInitialPresetThatTheReplacementCannotHaveIsFitted) {
  const std::string xml = plugin(maker_pro("a", "<initial preset_rad='0.5'/>"));
  const auto initial = [&](const config::Replacement& r) {
    return config::parse_plugin(xml, "arm.sdf", shipped(), r).actuators[0].initial_preset;
  };
  EXPECT_EQ(initial({"sea_example", {}}), 0) << "it has none";
  EXPECT_EQ(initial({"qbmove_maker_pro_6_1", {{"limits.preset_max", "0.3"}}}), 0.3);
  EXPECT_EQ(initial({"qbmove_maker_pro_6_1", {}}), 0.5);
}

TEST(Plugin, AReplacementsProblemsAreTold) {
  const std::string xml = plugin(kElbow);
  const auto told = [&](const config::Replacement& r) {
    const auto list = problems_of([&] { (void)config::parse_plugin(xml, "arm.sdf", shipped(), r); });
    return list.empty() ? std::string() : list[0].text();
  };
  EXPECT_NE(told({"nosuch", {}}).find("unknown actuator type"), std::string::npos);
  EXPECT_EQ(told({std::nullopt, {{"drive.friction_Nm", "much"}}, "--set"})
                .rfind("--set drive.friction_Nm = \"much\": must be a number", 0),
            0u)
      << "not the robot's file, which is right";
  EXPECT_NE(told({std::nullopt, {{"drive.friction_Nm", "much"}}, "--set"}).find("(actuator elbow, type sea_example)"),
            std::string::npos);
  EXPECT_NE(told({std::nullopt, {{"drive.friktion_Nm", "1"}}}).find("did you mean drive.friction_Nm"), std::string::npos);
}

TEST(Plugin, TheSmallestRobotIsOneJointAndOnePreset) {
  const host::RobotConfig robot = parse(plugin(kElbow));
  ASSERT_EQ(robot.buses.size(), 1u);
  EXPECT_EQ(robot.buses[0].name, "bus");
  EXPECT_EQ(robot.buses[0].baud_Hz, 2e6);
  EXPECT_EQ(robot.actuators.at(0).name, "elbow");
  EXPECT_EQ(robot.actuators.at(0).id, 1);
  EXPECT_EQ(robot.actuators.at(0).initial_preset, 0);
  EXPECT_EQ(robot.state_rate_Hz, 100);
}

TEST(Plugin, IdsThatAreNotGivenAreTheLowestFreeOnesInOrder) {
  const host::RobotConfig robot = parse(plugin(maker_pro("a") + maker_pro("b", "<bus id='1'/>") + maker_pro("c", "<bus/>")));
  EXPECT_EQ(robot.actuators[0].id, 2);
  EXPECT_EQ(robot.actuators[1].id, 1);
  EXPECT_EQ(robot.actuators[2].id, 3);
}

TEST(Plugin, ActuatorsLandOnTheBusTheyNameAndIdsCountABus) {
  const host::RobotConfig robot =
      parse(plugin("<bus name='left' baud='460800' cycle_s='0.02'/><bus name='right'/>" +
                   maker_pro("a", "<bus id='7'>right</bus>") + maker_pro("b", "<bus id='7'> left </bus>")));
  EXPECT_EQ(robot.actuators[0].bus, 1u);
  EXPECT_EQ(robot.actuators[1].bus, 0u);
  EXPECT_EQ(robot.buses[0].baud_Hz, 460800);
  EXPECT_EQ(robot.buses[0].cycle_s, 0.02);
}

TEST(Plugin, WhatHostsAndXmlAddIsTolerated) {
  const std::string xml =
      R"(<?xml version="1.0"?><!-- a --><plugin xmlns:gz="http://gz" gz:x="1" name="vsa::Robot" filename="f">)" + kElbow +
      "<!-- b --></plugin>";
  EXPECT_EQ(parse(xml).actuators.size(), 1u);
}

TEST(Plugin, ACycleOfExactlyTheWireTimeIsAccepted) {
  // Servos stand on the line's bus and don't talk on it.
  const std::string servo = "<actuator name='s'><joint>s</joint><type>ugurlu_sea</type><bus id='9'>b</bus></actuator>";
  EXPECT_EQ(parse(plugin("<bus name='b' cycle_s='0.00014'/>" + maker_pro("a") + servo)).actuators.size(), 2u);
  EXPECT_EQ(parse(plugin("<bus name='b' cycle_s='0.00014'/>" + maker_pro("a"))).buses[0].cycle_s, 0.00014);
}

TEST(Plugin, AThousandEqualActuatorsOnFourBusesAreReadOnce) {
  std::string inside;
  for (int b = 0; b < 4; ++b) inside += "<bus name='b" + std::to_string(b) + "'/>";
  for (int i = 0; i < 1000; ++i) inside += maker_pro("j" + std::to_string(i), "<bus>b" + std::to_string(i % 4) + "</bus>");
  const host::RobotConfig robot = parse(plugin(inside));
  EXPECT_EQ(robot.actuators.back().id, 250);
  EXPECT_EQ(robot.actuators.front().unit.actuator.transmission, robot.actuators.back().unit.actuator.transmission);
}

TEST(Plugin, TheProblemsOfAPresetThatManyUseAreToldOnce) {
  std::string inside;
  for (int i = 0; i < 12; ++i) inside += "<actuator><joint>j" + std::to_string(i) + "</joint><type>qbmov</type></actuator>";
  EXPECT_EQ(problems_in(plugin(inside)).size(), 1u);
}

TEST(Plugin, AllProblemsComeTogetherAndLeadWithWhere) {
  const auto problems =
      problems_in(plugin(maker_pro("a", "<initial preset_rad='1'/>") + maker_pro("a", "<override key='drive.x' value='1'/>") +
                         "<state_rate_Hz>fast</state_rate_Hz>"));
  EXPECT_EQ(problems.size(), 5u) << text_of(problems);
  for (const Problem& p : problems) EXPECT_EQ(p.file, "arm.sdf");
}

TEST(Plugin, ChildrenGivenAsAttributesAreToldOnceEachAndNothingElse) {
  EXPECT_EQ(problems_in(plugin("<actuator joint='elbow' type='qbmove_maker_pro'/>")).size(), 2u);
  EXPECT_EQ(problems_in("<plugin name='vsa::Robot' substeps='2' state_rate_Hz='50'>" + maker_pro("a") + "</plugin>").size(), 2u);
}

TEST(Plugin, ABusMayHearClientsAtAnyRate) {
  const auto robot =
      parse(plugin("<bus name='a'><serial_port any_rate='true'>p</serial_port></bus>"
                   "<bus name='b'><serial_port>q</serial_port></bus>" +
                   maker_pro("x", "<bus>a</bus>") + maker_pro("y", "<bus>b</bus>")));
  EXPECT_TRUE(robot.buses[0].any_rate);
  EXPECT_FALSE(robot.buses[1].any_rate);
  EXPECT_EQ(robot.buses[0].serial_port, "p");
}

TEST(Plugin, SubstepsAreKnownOrLeftToTheHost) {
  EXPECT_EQ(parse(plugin(kElbow)).substeps, std::nullopt);
  EXPECT_EQ(parse(plugin(kElbow + "<substeps>64</substeps>")).substeps, 64);
}

TEST(Plugin, WhatIsWrittenAndShownIsOrderedOrOff) {
  EXPECT_FALSE(parse(plugin(kElbow)).record);
  EXPECT_FALSE(parse(plugin(kElbow)).view_port);
  const host::RobotConfig robot = parse(plugin(kElbow + "<record directory='runs/1' rate_Hz='250'/><view port='8080'/>"));
  EXPECT_EQ(robot.record->directory, "runs/1");
  EXPECT_EQ(robot.record->rate_Hz, 250);
  EXPECT_EQ(robot.view_port, 8080);
  EXPECT_EQ(parse(plugin(kElbow + "<record directory='r'/>")).record->rate_Hz, 100);
  EXPECT_EQ(parse(plugin(kElbow + "<view/>")).view_port, 0);
}

TEST(Plugin, AHostThatCantMakeSubstepsSaysWhatToSetInstead) {
  Problems problems;
  for (const char* one : {"", "<substeps>1</substeps>"}) config::check_one_step(parse(plugin(kElbow + one)), "arm.sdf", problems);
  EXPECT_TRUE(problems.empty());
  config::check_one_step(parse(plugin(kElbow + "<substeps>4</substeps>")), "arm.sdf", problems);
  ASSERT_EQ(problems.list().size(), 1u);
  expect_pieces(problems.list()[0].text(), {"arm.sdf: substeps = 4", "<max_step_size>", "divided by 4"});
}

TEST(Plugin, JointsThatTheModelLacksAreReported) {
  Problems problems;
  const host::RobotConfig robot = parse(plugin(maker_pro("m::shaft_1") + maker_pro("m::shaft_2")));
  config::check_joints(robot, {"m::shaft_1", "m::shaft_3"}, "arm.sdf", problems);
  ASSERT_EQ(problems.list().size(), 1u);
  expect_pieces(problems.list()[0].text(), {"arm.sdf: actuator[m::shaft_2]/joint", "no such joint", "m::shaft_1, m::shaft_3"});
  config::check_joints(robot, {}, "arm.sdf", problems);
  EXPECT_EQ(problems.list().size(), 3u);
}

struct BadPlugin {
  const char* name;
  std::string xml;
  std::vector<std::string> pieces;
  std::size_t problems = 1;
};

std::ostream& operator<<(std::ostream& out, const BadPlugin& bad) { return out << bad.name; }

class PluginBadInput : public testing::TestWithParam<BadPlugin> {};

TEST_P(PluginBadInput, IsRefusedWithWhatIsWrong) {
  const BadPlugin& bad = GetParam();
  const auto problems = problems_in(bad.xml);
  EXPECT_EQ(problems.size(), bad.problems) << text_of(problems);
  expect_pieces(text_of(problems), bad.pieces);
  for (const Problem& p : problems) EXPECT_EQ(p.file, "arm.sdf");
}

INSTANTIATE_TEST_SUITE_P(
    Form, PluginBadInput,
    testing::Values(
        BadPlugin{"nothing", "", {"not well-formed XML"}},
        BadPlugin{"broken", "<plugin\n name='vsa::Robot'><actuator></plugin>", {"not well-formed XML, line 2"}},
        BadPlugin{"comment_only", "<!-- -->", {"not well-formed XML"}},
        BadPlugin{"two_roots", plugin(kElbow) + "<plugin/>", {"a second element at the top"}},
        BadPlugin{"other_root", "<robot name='vsa::Robot'>" + kElbow + "</robot>", {"is not a plug-in element"}},
        BadPlugin{"other_name", "<plugin name='vsa::Robt'>" + kElbow + "</plugin>", {"plugin@name = \"vsa::Robt\"", "vsa::Robot"}},
        BadPlugin{"no_actuator", plugin(""), {"has no actuator"}},
        BadPlugin{"unknown_element", plugin("<actuatr/>" + kElbow), {"plugin/actuatr: element unknown, did you mean actuator?"}},
        BadPlugin{"unknown_inner", plugin(maker_pro("a", "<jiont>a</jiont>")), {"actuator[1]/jiont", "did you mean joint?"}},
        BadPlugin{"unknown_attribute", plugin(maker_pro("a", "", " nam='x'")), {"actuator[1]@nam = x", "did you mean name?"}},
        BadPlugin{"stray_text", plugin("hello" + kElbow), {"plugin = hello: text is not allowed here"}},
        BadPlugin{"element_in_text", plugin(maker_pro("a<b/>")), {"actuator[1]/joint/b", "only text"}},
        BadPlugin{"no_joint", plugin("<actuator><type>sea_example</type></actuator>"), {"actuator[1]/joint: is missing"}},
        BadPlugin{"empty_joint", plugin(maker_pro(" ")), {"actuator[1]/joint: is empty"}},
        BadPlugin{"no_type", plugin("<actuator><joint>a</joint></actuator>"), {"actuator[1]/type: is missing"}},
        BadPlugin{"two_types", plugin(maker_pro("a", "<type>sea_example</type>")), {"type: is given more than once"}},
        BadPlugin{
            "two_rates", plugin(kElbow + "<state_rate_Hz>1</state_rate_Hz><state_rate_Hz>2</state_rate_Hz>"), {"more than once"}},
        BadPlugin{
            "rate_zero", plugin(kElbow + "<state_rate_Hz>0</state_rate_Hz>"), {"state_rate_Hz = 0: is out of range", "1000 Hz"}},
        BadPlugin{"rate_high", plugin(kElbow + "<state_rate_Hz>1001</state_rate_Hz>"), {"is out of range"}},
        BadPlugin{"rate_nan", plugin(kElbow + "<state_rate_Hz>nan</state_rate_Hz>"), {"must be a finite number"}},
        BadPlugin{"rate_empty", plugin(kElbow + "<state_rate_Hz/>"), {"must be a finite number"}},
        BadPlugin{"two_substeps", plugin(kElbow + "<substeps>2</substeps><substeps>2</substeps>"), {"substeps", "more than once"}},
        BadPlugin{"substeps_zero", plugin(kElbow + "<substeps>0</substeps>"), {"substeps = \"0\": is out of range", "1 … 64"}},
        BadPlugin{"substeps_high", plugin(kElbow + "<substeps>65</substeps>"), {"substeps = \"65\": is out of range", "1 … 64"}},
        BadPlugin{"substeps_part", plugin(kElbow + "<substeps>2.5</substeps>"), {"substeps = \"2.5\"", "whole"}},
        BadPlugin{"substeps_empty", plugin(kElbow + "<substeps/>"), {"substeps"}},
        BadPlugin{"record_nowhere", plugin(kElbow + "<record/>"), {"record@directory", "is missing"}},
        BadPlugin{"record_empty", plugin(kElbow + "<record directory=''/>"), {"record@directory", "is empty"}},
        BadPlugin{"record_rate", plugin(kElbow + "<record directory='r' rate_Hz='0'/>"), {"record@rate_Hz = 0: is out of range"}},
        BadPlugin{"record_hertz", plugin(kElbow + "<record directory='r' rate_hz='9'/>"), {"rate_hz", "rate_Hz"}},
        BadPlugin{"record_text", plugin(kElbow + "<record directory='r'>runs</record>"), {"record = runs", "not allowed"}},
        BadPlugin{"two_records", plugin(kElbow + "<record directory='r'/><record directory='s'/>"), {"record", "more than once"}},
        BadPlugin{"view_port", plugin(kElbow + "<view port='65536'/>"), {"view@port = \"65536\": is out of range", "65535"}},
        BadPlugin{"substeps_unit", plugin(kElbow + "<substeps unit='1'>2</substeps>"), {"substeps@unit"}}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Names, PluginBadInput,
    testing::Values(
        BadPlugin{"space", plugin(maker_pro("a", "", " name='left arm'")), {"actuator[left arm]@name", "can't be a name"}},
        BadPlugin{"at", plugin(maker_pro("a", "", " name='a@b'")), {"can't be a name"}},
        BadPlugin{"slash", plugin(maker_pro("a", "", " name='a//b'")), {"can't be a name"}},
        BadPlugin{"equals", plugin(maker_pro("a", "", " name='a::=b'")), {"can't be a name"}},
        BadPlugin{"comma", plugin(maker_pro("a", "", " name='a,b'")), {"can't be a name"}},
        BadPlugin{"empty", plugin(maker_pro("a", "", " name=''")), {"can't be a name"}},
        BadPlugin{"from_joint", plugin(maker_pro("left arm")), {"actuator[1]/joint", "give it a name attribute"}},
        BadPlugin{
            "twice", plugin(maker_pro("a", "", " name='x'") + maker_pro("b", "", " name='x'")), {"two actuators have this name"}},
        BadPlugin{"joint_twice",
                  plugin(maker_pro("a", "", " name='x'") + maker_pro("a", "", " name='y'")),
                  {"actuator[y]/joint = \"a\"", "actuator[x] drives this joint already"}},
        BadPlugin{"channel", plugin(maker_pro("a") + maker_pro("a_preset")), {"\"a_preset\"", "is a channel of"}},
        BadPlugin{"motor", plugin(maker_pro("a_motor_2") + maker_pro("a")), {"\"a_motor_2\"", "is a channel of"}}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Buses, PluginBadInput,
    testing::Values(
        BadPlugin{"unknown",
                  plugin("<bus name='arm'/>" + maker_pro("a", "<bus>leg</bus>")),
                  {"actuator[1]/bus = \"leg\": no such bus", "arm"}},
        BadPlugin{"undeclared", plugin(maker_pro("a", "<bus>leg</bus>")), {"declare it: <bus name=\"leg\"/>"}},
        BadPlugin{"which", plugin("<bus name='l'/><bus name='r'/>" + maker_pro("a")), {"must say which bus", "l, r"}},
        BadPlugin{"idle",
                  plugin("<bus name='l'/><bus name='r'/>" + maker_pro("a", "<bus>l</bus>")),
                  {"bus[r]: no actuator is on this bus"}},
        BadPlugin{
            "twice", plugin("<bus name='l'/><bus name='l'/>" + maker_pro("a", "<bus>l</bus>")), {"two buses have this name"}, 2},
        BadPlugin{"nameless", plugin("<bus/>" + maker_pro("a")), {"bus[]@name", "can't be a name"}},
        BadPlugin{"id_twice",
                  plugin(maker_pro("a", "<bus id='3'/>") + maker_pro("b", "<bus id='3'/>")),
                  {"actuator[2]/bus@id = 3: actuator[1] has this id on the same bus"}},
        BadPlugin{"id_zero", plugin(maker_pro("a", "<bus id='0'/>")), {"bus@id = \"0\": is out of range", "1 … 254"}},
        BadPlugin{"id_255", plugin(maker_pro("a", "<bus id='255'/>")), {"is out of range"}},
        BadPlugin{"id_text", plugin(maker_pro("a", "<bus id='1.0'/>")), {"must be a whole number"}},
        BadPlugin{"baud_low", plugin("<bus name='b' baud='300'/>" + maker_pro("a")), {"bus[b]@baud = \"300\"", "9600 … 10000000"}},
        BadPlugin{"baud_text", plugin("<bus name='b' baud='2M'/>" + maker_pro("a")), {"must be a whole number"}},
        BadPlugin{"cycle_text", plugin("<bus name='b' cycle_s='fast'/>" + maker_pro("a")), {"must be auto or a time"}},
        BadPlugin{"cycle_negative", plugin("<bus name='b' cycle_s='-1'/>" + maker_pro("a")), {"must be auto or a time"}},
        BadPlugin{"cycle_short",
                  plugin("<bus name='b' cycle_s='0.00013'/>" + maker_pro("a")),
                  {"is shorter than the time on the wire of 1 units", "at least 0.00014 s"}},
        BadPlugin{"children_as_attributes",
                  kHead + "<actuator joint='elbow' type='qbmove_maker_pro' bus='arm'/><bus name='arm' serial_port='p'/></plugin>",
                  {"actuator[1]@joint = \"elbow\": is an element, not an attribute (allowed: <joint>elbow</joint>)",
                   "<type>qbmove_maker_pro</type>", "<bus>arm</bus>", "<serial_port>p</serial_port>"},
                  4},
        BadPlugin{"texts_as_attributes",
                  replaced(plugin(kElbow), "<joint>elbow</joint>", "<joint name='elbow'/>"),
                  {"/joint@name = \"elbow\": is no attribute: the value is the element's text (allowed: <joint>elbow</joint>)",
                   "/joint: is empty"},
                  2},
        BadPlugin{"port_any_rate_not_a_switch",
                  plugin("<bus name='b'><serial_port any_rate='yes'>p</serial_port></bus>" + maker_pro("a")),
                  {"bus[b]/serial_port@any_rate = \"yes\"", "true, false"}},
        BadPlugin{"port_empty", plugin("<bus name='b'><serial_port></serial_port></bus>" + maker_pro("a")), {"bus[b]/serial_port"}},
        BadPlugin{"port_name",
                  plugin("<bus name='b'><serial_port>my port</serial_port></bus>" + maker_pro("a")),
                  {"bus[b]/serial_port = \"my port\": can't be the name of a serial port", "letters, digits"}},
        BadPlugin{"port_relative",
                  plugin("<bus name='b'><serial_port>../x</serial_port></bus>" + maker_pro("a")),
                  {"can't be the name of a serial port"}},
        BadPlugin{"port_twice",
                  plugin("<bus name='b'><serial_port>p</serial_port></bus><bus name='c'><serial_port>p</serial_port></bus>" +
                         maker_pro("a", "<bus>b</bus>") + maker_pro("d", "<bus>c</bus>")),
                  {"bus[c]/serial_port = \"p\": bus[b] has this port"}}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Values, PluginBadInput,
    testing::Values(
        BadPlugin{"unknown_preset",
                  plugin("<actuator><joint>a</joint><type>qbmove</type></actuator>"),
                  {"actuator[1]/type = \"qbmove\": unknown actuator type, did you mean qbmove_advanced?", "sea_example"}},
        BadPlugin{"preset_high",
                  plugin(maker_pro("a", "<initial preset_rad='0.8'/>")),
                  {"initial@preset_rad = 0.8", "-0.785 … 0.785 rad"}},
        BadPlugin{
            "preset_unit", plugin(maker_pro("a", "<initial preset_m='0.1'/>")), {"is not this actuator's preset", "preset_rad"}},
        BadPlugin{"preset_for_none",
                  replaced(plugin(kElbow), "</actuator>", "<initial preset_rad='0.1'/></actuator>"),
                  {"this actuator has no preset"}},
        BadPlugin{"equilibrium_far", plugin(maker_pro("a", "<initial equilibrium_rad='3'/>")), {"beyond the firmware's limits"}, 2},
        BadPlugin{"equilibrium_of_a_servo",
                  replaced(plugin(maker_pro("a", "<initial equilibrium_rad='7'/>")), "qbmove_maker_pro_6_1", "tree_orange_80"),
                  {"7 rad", "control.reference_max_rad", "6.28"}},
        BadPlugin{"equilibrium_text", plugin(maker_pro("a", "<initial equilibrium_rad='1e'/>")), {"must be a finite number"}},
        BadPlugin{"initial_unknown",
                  plugin(maker_pro("a", "<initial equilibrium='1'/>")),
                  {"did you mean equilibrium_", "equilibrium_rad, equilibrium_m"}},
        BadPlugin{"initial_unknown_beside_the_preset",
                  plugin(maker_pro("a", "<initial preset_rad='0.1' foo='1'/>")),
                  {"(allowed: equilibrium_rad, equilibrium_m, preset_rad)"}},
        BadPlugin{"override_range",
                  plugin(maker_pro("a", "<override key='drive.friction_Nm' value='-1'/>")),
                  {"actuator[1]/override[drive.friction_Nm] = \"-1\"", "outside"}},
        BadPlugin{"override_key",
                  plugin(maker_pro("a", "<override key='drive.friktion_Nm' value='1'/>")),
                  {"did you mean drive.friction_Nm?"}},
        BadPlugin{"override_half", plugin(maker_pro("a", "<override key='drive.friction_Nm'/>")), {"override@value: is missing"}},
        BadPlugin{"override_empty", plugin(maker_pro("a", "<override/>")), {"override@key: is missing", "override@value"}, 2}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace vsa::test
