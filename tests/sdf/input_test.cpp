// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Bad input: each error names what it is about, and nothing gets through in silence.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

using ::testing::Test;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string model(const std::string& content) { return world("<model name='m'>" + content + "</model>"); }

std::string link(const std::string& name, const std::string& content) { return "<link name='" + name + "'>" + content + "</link>"; }

std::string moments(double xx, double yy, double zz) {
  return "<inertial><mass>1</mass><inertia><ixx>" + std::to_string(xx) + "</ixx><iyy>" + std::to_string(yy) + "</iyy><izz>" +
         std::to_string(zz) + "</izz></inertia></inertial>";
}

TEST(BadInput, AMissingFileIsNamed) {
  try {
    static_cast<void>(World::load("/nowhere/at/all.sdf"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(has(error.what(), "/nowhere/at/all.sdf: no such file")) << error.what();
  }
}

TEST(BadInput, AWorldThatBringsAllItsOwnNeedsNoDataDirectory) {
  const TempDir dir("alone");
  std::ofstream(dir.path() / "alone.sdf") << model(link("l", moments(1, 1, 1)));
  ASSERT_EQ(::setenv("VSA_DATA_DIR", "/nowhere", 1), 0);
  EXPECT_NO_THROW(static_cast<void>(World::load(dir.path() / "alone.sdf")));
  ::unsetenv("VSA_DATA_DIR");
}

TEST(BadInput, CircularIncludesAreNamedInsteadOfFollowed) {
  const TempDir dir("circle");
  const auto write = [&](const char* name, const char* other) {
    std::ofstream(dir.path() / name) << "<sdf version='1.7'><model name='" << name[0] << "'><link name='l'/><include><uri>" << other
                                     << "</uri></include></model></sdf>";
  };
  write("a.sdf", "b.sdf");
  write("b.sdf", "a.sdf");
  try {
    static_cast<void>(World::load(dir.path() / "a.sdf"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(has(error.what(), "b.sdf: include/uri = a.sdf")) << error.what();
    EXPECT_TRUE(has(error.what(), "circle")) << error.what();
  }
}

TEST(BadInput, AVersionThatIsNotOneIsRefused) {
  for (const char* version : {"abc", "99", "", "1.13", "-1.7"}) {
    const std::string text = problems_of("<sdf version='" + std::string(version) + "'><world name='w'/></sdf>");
    EXPECT_TRUE(has(text, "sdf@version")) << version << ": " << text;
    EXPECT_TRUE(has(text, "1.6 … 1.12")) << version << ": " << text;
  }
}

TEST(BadInput, AValueThatIsMoreThanItsNumbersIsRefusedWithWhatItIs) {
  const auto with = [](const std::string& axis, const std::string& more) {
    return problems_of("<sdf version='1.9'><world name='w'><model name='m'>" + link("a", moments(1, 1, 1)) +
                       link("b", "<pose>0 0 1 0 0 0</pose>" + moments(1, 1, 1) + more) +
                       "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis>" + axis +
                       "</axis></joint></model></world></sdf>");
  };
  const std::string z = "<xyz>0 0 1</xyz>";
  for (const auto& [axis, said] : std::vector<std::pair<std::string, std::string>>{
           {"<xyz>0 1 0 5</xyz>", "SDF text:1: world[w]/model[m]/joint[j]/axis/xyz = 0 1 0 5: isn't three numbers"},
           {"<xyz>0 1 0x</xyz>", "axis/xyz = 0 1 0x: isn't three numbers"},
           {z + "<dynamics><damping>0.1 x</damping></dynamics>",
            "axis/dynamics/damping = 0.1 x: isn't a number (allowed: a number"},
           {z + "<limit><lower>-1rad</lower><upper>1</upper></limit>", "axis/limit/lower = -1rad: isn't a number"},
           {z + "<limit><lower>-1</lower><upper>0,5</upper></limit>", "axis/limit/upper = 0,5: isn't a number"},
           {z + "<limit><lower>-1</lower><upper>0<!-- rad -->5</upper></limit>", "axis/limit/upper = 0 5: isn't a number"}}) {
    const std::string text = with(axis, "");
    EXPECT_TRUE(has(text, said)) << axis << ": " << text;
  }
  for (const char* number : {"1", " +1.0 ", "1.", "1e0", "inf", "0x1", "1e16"})
    EXPECT_EQ(with(z + "<limit><lower>-1</lower><upper>" + number + "</upper></limit>", ""), "") << number;
  const auto shape = [](const std::string& surface) {
    return "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface><contact>" + surface +
           "</contact></surface></collision>";
  };
  EXPECT_TRUE(has(with(z, shape("<collide_bitmask>3.5</collide_bitmask>")), "collide_bitmask = 3.5: isn't a whole number"));
  for (const char* mask : {"4294967296", "0x100000000", "-1", "1e3"})
    EXPECT_TRUE(has(with(z, shape("<collide_bitmask>" + std::string(mask) + "</collide_bitmask>")),
                    std::string("collide_bitmask = ") + mask + ": isn't a whole number in range (allowed: 0 … 4294967295)"))
        << mask;
  for (const char* mask : {"0xffff", "0xffffffff", "4294967295", "+3", "3.0"})
    EXPECT_EQ(with(z, shape("<collide_bitmask>" + std::string(mask) + "</collide_bitmask>")), "") << mask;
  EXPECT_EQ(with(z, "<sensor name='s' type='imu'><update_rate>5 Hz</update_rate></sensor>"), "") << "it is left out whole";
}

TEST(BadInput, BrokenXmlIsRefusedAndNothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const std::string text = problems_of("<sdf version='1.9'><world name='w'><model name='m'></world></sdf>");
  const std::string printed = ::testing::internal::GetCapturedStderr() + ::testing::internal::GetCapturedStdout();
  EXPECT_TRUE(has(text, "SDF text: Error parsing XML")) << text;
  EXPECT_TRUE(has(text, "MISMATCHED_ELEMENT")) << text;
  EXPECT_EQ(printed, "");
}

TEST(BadInput, WhatIsNoXmlIsCalledThat) {
  for (const char* text : {"[scenario]\nworld = 'snake_flat'\n", "snake_flat", "\n  {\"world\": 1}", ")"})
    EXPECT_EQ(problems_of(text), "SDF text: isn't XML (allowed: an SDF or URDF file)") << text;
  for (const char* text : {"", " \n\t"}) EXPECT_EQ(problems_of(text), "SDF text: is empty (allowed: an SDF or URDF file)") << text;
  for (const char* before : {"", "\n ", "\xEF\xBB\xBF"}) EXPECT_EQ(problems_of(before + model(link("a", ""))), "") << before;
}

TEST(BadInput, SdfErrorsArePrintedNowhereButInTheException) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const std::string text = problems_of(model(link("a", "<inertial><mass>abc</mass></inertial>") + "<frictoin>3</frictoin>"));
  const std::string printed = ::testing::internal::GetCapturedStderr() + ::testing::internal::GetCapturedStdout();
  EXPECT_TRUE(has(text, "Unable to set value [abc ] for key[mass]")) << text;
  EXPECT_FALSE(has(text, "robot")) << text;
  EXPECT_EQ(printed, "");
}

TEST(BadInput, ADoctypeIsNoTextBesideTheRoot) {
  const std::string text = model(link("a", inertial(1, 1)));
  const auto after_declaration = [&](const std::string& what) {
    std::string with = text;
    return problems_of(with.insert(with.find("?>") + 2, what));
  };
  EXPECT_EQ(after_declaration("<!DOCTYPE sdf [<!ENTITY a 'b'>]>"), "");
  EXPECT_TRUE(has(after_declaration("lost words"), "lost words: stands outside"));
}

TEST(BadInput, AMisspeltElementIsRefused) {
  EXPECT_TRUE(has(problems_of(model(link("a", inertial(1, 1)) + "<frictoin>3</frictoin>")), "frictoin"));
}

TEST(BadInput, MassesThatAreNoMassesAreNamedAllAtOnce) {
  const std::string text =
      problems_of(model(link("a", "<inertial><mass>nan</mass></inertial>") + link("b", "<inertial><mass>-1</mass></inertial>") +
                        link("c", "<inertial><mass>0</mass></inertial>")));
  EXPECT_TRUE(has(text, "m::a/inertial/mass = nan")) << text;
  EXPECT_TRUE(has(text, "m::b/inertial/mass = -1")) << text;
  EXPECT_TRUE(has(text, "m::c/inertial/mass = 0")) << text;
}

TEST(BadInput, AnInertiaThatViolatesTheTriangleInequalityIsNamed) {
  const std::string text = problems_of(model(link("a", moments(1, 1, 3)) + link("b", moments(-1, 1, 1))));
  EXPECT_TRUE(has(text, "m::a/inertial/inertia")) << text;
  EXPECT_TRUE(has(text, "triangle")) << text;
  EXPECT_TRUE(has(text, "m::b/inertial/inertia")) << text;
}

TEST(BadInput, ALinkThatMovesAndIsTooLightForTheEngineIsNamed) {
  const auto b = [](double mass, double moment) {
    const auto tag = [](const std::string& name, double value) {
      std::ostringstream text;
      text << '<' << name << '>' << value << "</" << name << '>';
      return text.str();
    };
    return link("b", "<inertial>" + tag("mass", mass) + "<inertia>" + tag("ixx", moment) + tag("iyy", moment) + tag("izz", moment) +
                         "</inertia></inertial>");
  };
  const auto joint = [](const char* type, const std::string& ends) {
    return "<joint name='" + ends + "' type='" + type + "'><parent>" + ends[0] + "</parent><child>" + ends[1] +
           "</child><axis><xyz>0 0 1</xyz></axis></joint>";
  };
  const std::string a = link("a", inertial(1, 1)), hinge = joint("revolute", "ab");
  std::string text = problems_of(model(a + b(1e-20, 1) + hinge));
  EXPECT_TRUE(has(text, "m::b/inertial/mass = 1e-20: is too little for MuJoCo in a link that moves (allowed: ≥ 1e-15 kg)")) << text;
  text = problems_of(model(a + b(1, 1e-20) + hinge));
  EXPECT_TRUE(has(text, "m::b/inertial/inertia = smallest principal moment 1e-20")) << text;
  EXPECT_FALSE(has(text, "mjMINVAL")) << text;
  EXPECT_TRUE(has(problems_of(model(b(1e-20, 1))), "m::b/inertial/mass")) << "a free one";
  EXPECT_EQ(problems_of(model(a + b(1e-20, 1e-20) + joint("fixed", "ab"))), "");
  EXPECT_EQ(problems_of(model(a + b(1e-20, 1e-20) + hinge + link("c", inertial(1, 1)) + joint("fixed", "bc"))), "")
      << "what is fixed to it has mass";
}

TEST(BadInput, AThinPlateAtTheEdgeOfTheTriangleInequalityIsAccepted) {
  EXPECT_EQ(problems_of(model(link("a", moments(0.1, 0.2, 0.3)))), "");
}

TEST(BadInput, UnknownAndUnsupportedJointTypesAreNamed) {
  const std::string two = link("a", inertial(1, 1)) + link("b", inertial(1, 1));
  const auto joint = [&](const std::string& type) {
    return problems_of(model(two + "<joint name='j' type='" + type +
                             "'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis>" +
                             (type == "revolute2" ? "<axis2><xyz>1 0 0</xyz></axis2>" : "") + "</joint>"));
  };
  for (const char* type : {"wobbly", "screw", "gearbox", "revolute2"}) {
    const std::string text = joint(type);
    EXPECT_TRUE(has(text, "m::j/type = ") && has(text, type) && has(text, "revolute, continuous")) << type << ": " << text;
  }
  EXPECT_EQ(joint("revolute"), "");
}

TEST(BadInput, LoopsOfJointsThatNoConstraintCanBeAreNamed) {
  const std::string three = link("a", inertial(1, 1)) + link("b", inertial(1, 1)) + link("c", inertial(1, 1));
  const auto text = [&](const std::string& type, const std::string& of_axis, const std::string& more = "") {
    const auto j = [&](const std::string& a, const std::string& b) {
      return "<joint name='" + a + b + "' type='" + type + "'><parent>" + a + "</parent><child>" + b +
             "</child><axis><xyz>0 0 1</xyz>" + of_axis + "</axis></joint>";
    };
    return problems_of(model(three + j("a", "b") + j("b", "c") + j("a", "c") + more));
  };
  EXPECT_EQ(text("revolute", ""), "");
  EXPECT_TRUE(has(text("prismatic", ""), "m::bc: closes a kinematic loop and has a slide"));
  EXPECT_TRUE(has(text("prismatic", ""), "one of m::ab, m::ac, m::bc that is revolute"));
  for (const auto& [of_axis, said] : std::vector<std::pair<std::string, std::string>>{
           {"<limit><lower>-1</lower><upper>1</upper></limit>", "limits"},
           {"<dynamics><damping>1</damping></dynamics>", "damping"},
           {"<dynamics><friction>1</friction></dynamics>", "friction"},
           {"<dynamics><spring_stiffness>1</spring_stiffness></dynamics>", "a spring"},
           {"<limit><lower>-1</lower><upper>1</upper></limit><dynamics><damping>1</damping></dynamics>", "limits, damping"}})
    EXPECT_TRUE(has(text("revolute", of_axis), "m::bc: closes a kinematic loop and has " + said + " "))
        << text("revolute", of_axis);
  std::string driven;
  for (const char* j : {"ab", "bc", "ac"})
    driven += "<actuator><joint> " + std::string(j) + " </joint><type>sea_example</type></actuator>";
  EXPECT_TRUE(has(text("revolute", "", "<plugin name='vsa::Robot' filename='x'>" + driven + "</plugin>"),
                  "closes a kinematic loop and has an actuator"));
}

TEST(BadInput, AJointToALinkThatIsntThereIsNamed) {
  EXPECT_TRUE(has(
      problems_of(model(link("a", inertial(1, 1)) + "<joint name='j' type='fixed'><parent>a</parent><child>ghost</child></joint>")),
      "ghost"));
}

TEST(BadInput, AMissingIncludeIsNamed) {
  EXPECT_TRUE(has(problems_of(world("<include><uri>model://no_such_model</uri></include>")), "model://no_such_model"));
}

TEST(BadInput, PhysicsThatCantBeHonouredIsNamed) {
  const auto with = [](const std::string& surface) {
    return problems_of(
        model(link("a", inertial(1, 1) + "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface>" +
                            surface + "</surface></collision>")));
  };
  EXPECT_TRUE(
      has(with("<bounce><restitution_coefficient>0.5</restitution_coefficient></bounce>"), "restitution_coefficient = 0.5"));
  EXPECT_TRUE(has(with("<friction><ode><mu>0.5</mu><mu2>0.1</mu2><fdir1>nan 0 0</fdir1></ode></friction>"), "ode/fdir1"));
  EXPECT_TRUE(has(with("<friction><ode><mu>-1</mu></ode></friction>"), "value [-1] is less than the minimum"));
  EXPECT_TRUE(has(with("<friction><ode><mu>nan</mu></ode></friction>"), "ode/mu = nan"));
  EXPECT_TRUE(has(with("<friction><ode><slip1>1</slip1></ode></friction>"), "slip1"));
  EXPECT_EQ(with("<friction><ode><mu>0.5</mu></ode></friction>"), "");
  EXPECT_TRUE(has(problems_of(model(link("a", inertial(1, 1) + "<collision name='c'><geometry><plane/></geometry></collision>"))),
                  "can't move"));
  EXPECT_TRUE(has(problems_of(model(link(
                      "a", inertial(1, 1) + "<collision name='c'><geometry><box><size>1 0 1</size></box></geometry></collision>"))),
                  "box/size"));
}

TEST(BadInput, AStepOutOfRangeIsNamed) {
  WorldOptions options;
  options.step_s = 0.5;
  EXPECT_TRUE(has(problems_of(model(link("a", inertial(1, 1))), options), "step_s = 0.5"));
}

TEST(BadInput, NamesThatArentThereAreAnsweredWithTheNamesThatAre) {
  World w = World::load_string(
      model(link("a", inertial(1, 1)) + link("b", inertial(1, 1)) +
            "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>"));
  EXPECT_THROW(static_cast<void>(w.joint_angle("m::k")), InputError);
  EXPECT_THROW(w.set_joint("m::j", 0.0 / 0.0, 0), InputError);
  EXPECT_THROW(static_cast<void>(w.actuator("m")), InputError);
  EXPECT_THROW(static_cast<void>(w.center_of_mass("n")), InputError);
  try {
    static_cast<void>(w.joint_angle("m::k"));
  } catch (const InputError& error) {
    EXPECT_TRUE(has(error.what(), "m::j")) << error.what();
  }
}

TEST(Warnings, WhatIsLeftOutIsNamedOnce) {
  const std::string sensor = "<sensor name='s' type='imu'/>";
  World w = World::load_string(world("<light name='sun' type='point'/><model name='m'>" + link("a", inertial(1, 1) + sensor) +
                                     link("b", inertial(1, 1) + sensor) +
                                     "<plugin name='x::Other' filename='libother.so'><k>1</k></plugin></model>"));
  ASSERT_EQ(w.warnings().size(), 2u) << "a light is for a renderer";
  EXPECT_EQ(w.warnings()[0], "sensors are left out: m::a and 1 more");
  EXPECT_EQ(w.warnings()[1], "foreign plugins are left out: m/plugin[x::Other]");
}

}  // namespace
}  // namespace vsa::engine::testing
