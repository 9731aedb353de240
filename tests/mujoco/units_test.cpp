// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a model says of a unit, and what becomes of it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../record/scratch.hpp"
#include "rig.hpp"

namespace vsa::mujoco::test {
namespace {

std::string config(const std::string& more = "", const std::string& type = "qbmove_maker_pro_6_1") {
  return "<config key=\"type\" value=\"" + type + "\"/>" + more;
}
std::string key(const std::string& name, const std::string& value) {
  return "<config key=\"" + name + "\" value=\"" + value + "\"/>";
}

double reading(const Data& data, Reading which) { return data.sensor(0)[static_cast<std::size_t>(which)]; }

void run(Data& data, int steps) {
  for (int k = 0; k < steps; ++k) data.step();
}

TEST(Unit, GoesWhereItsControlsSay) {
  const Rig rig(mjcf_of());
  Data data(rig);
  data.d().ctrl[0] = 0.5;
  data.d().ctrl[1] = 0.3;
  run(data, 2000);
  EXPECT_NEAR(data.d().qpos[0], 0.5, 0.05);
  EXPECT_NEAR(reading(data, Reading::preset), 0.3, 0.02);
  EXPECT_NEAR(reading(data, Reading::equilibrium), 0.5, 0.05);
  EXPECT_GT(reading(data, Reading::stiffness), 0.5);
  EXPECT_GT(reading(data, Reading::energy_supply), 0);
  EXPECT_NEAR(reading(data, Reading::ticks_shaft), 0.5 * 32768 / (2 * M_PI), 300);
}

/// `joints` links of 0.3 kg below each other, each hinge with a damper, all held at the largest preset.
std::string damped_chain(int joints, double damping, double step_s) {
  std::string instances, bodies, ends, actuators;
  for (int i = 1; i <= joints; ++i) {
    const std::string n = std::to_string(i);
    instances += "<instance name=\"u" + n + "\">" + config(key("preset", "0.785")) + "</instance>";
    bodies += std::string("<body") + (i > 1 ? " pos=\"0 0 -0.08\"" : "") + "><joint name=\"j" + n + "\" axis=\"0 1 0\" damping=\"" +
              std::to_string(damping) + "\"/><inertial mass=\"0.3\" pos=\"0 0 -0.04\" diaginertia=\"1.6e-4 1.6e-4 1.6e-4\"/>";
    ends += "</body>";
    for (const char* what : {"e", "p"})
      actuators +=
          std::string("<plugin name=\"") + what + n + "\" joint=\"j" + n + "\" plugin=\"vsasim.unit\" instance=\"u" + n + "\"/>";
  }
  return "<mujoco><extension><plugin plugin=\"vsasim.unit\">" + instances +
         "</plugin></extension><option gravity=\"0 0 0\" timestep=\"" + std::to_string(step_s) + "\"/><worldbody>" + bodies + ends +
         "</worldbody><actuator>" + actuators + "</actuator></mujoco>";
}

TEST(Unit, JointsWithDampersComeToRest) {
  // They shook for ever, at up to 3.6 rad/s, when a damper went on with what it had done in the last step.
  for (const int joints : {1, 4}) {
    for (const double damping : {0.03, 0.1, 1.0}) {
      for (const double step_s : {1e-3, 2e-3, 4e-3}) {
        const Rig rig(damped_chain(joints, damping, step_s));
        Data data(rig);
        for (int i = 0; i < joints; ++i) data.d().ctrl[2 * i + 1] = 0.785;
        data.d().qvel[0] = 0.05;
        run(data, static_cast<int>(2 / step_s));
        double vv = 0;
        for (int k = 0; k < 100; ++k) {
          data.step();
          for (int i = 0; i < joints; ++i) vv += data.d().qvel[i] * data.d().qvel[i] / (100 * joints);
        }
        EXPECT_LT(std::sqrt(vv), 0.02) << joints << " joints, " << damping << " N·m·s/rad, " << step_s << " s";
      }
    }
  }
}

TEST(Unit, BeginsWhereItsConfigurationSays) {
  One one;
  one.config = config(key("equilibrium", "0.3") + key("preset", "0.4"));
  const Rig rig(mjcf_of(one));
  Data data(rig);
  data.d().ctrl[0] = 0.3;
  data.d().ctrl[1] = 0.4;
  data.forward();
  EXPECT_NEAR(reading(data, Reading::equilibrium), 0.3, 1e-3);
  EXPECT_NEAR(reading(data, Reading::preset), 0.4, 1e-3);
}

TEST(Unit, OverridesReplaceItsTypesValues) {
  One weak;
  weak.config = config(key("override", "drive.supply_V=0 drive.friction_Nm=0.7"));
  const Rig rig(mjcf_of(weak));
  Data data(rig);
  data.d().ctrl[0] = 0.5;
  run(data, 500);
  EXPECT_NEAR(data.d().qpos[0], 0, 1e-3) << "moved without a supply";
}

TEST(Unit, ATypeMayBeAFile) {
  const record::Scratch scratch;
  record::spew(
      scratch.path() / "mine.toml",
      "[type]\nname = \"mine\"\ntitle = \"mine\"\nbase = \"qbmove_maker_pro_6_1\"\n[drive]\nsupply_V = { value = 20.0, unit = "
      "\"V\", bounds = [0.0, 30.0], source = \"test\" }\n");
  One one;
  one.config = config("", (scratch.path() / "mine.toml").string());
  const Rig rig(mjcf_of(one));
  Data data(rig);
  data.d().ctrl[0] = 0.5;
  run(data, 1500);
  EXPECT_NEAR(data.d().qpos[0], 0.5, 0.06);
}

TEST(Unit, FaultsAreThereFromTheFirstStepAndAfterAReset) {
  One one;
  one.config = config(key("faults", "off"));
  const Rig rig(mjcf_of(one));
  Data data(rig);
  for (int again = 0; again < 2; ++again) {
    data.reset();
    data.d().ctrl[0] = 0.5;
    run(data, 300);
    EXPECT_NEAR(data.d().qpos[0], 0, 1e-6) << "a unit without power moves";
  }
}

TEST(Unit, NoiseComesFromItsSeedAlone) {
  const auto ticks = [](const char* words) {
    One one;
    one.config = config(key("faults", words));
    const Rig rig(mjcf_of(one));
    Data data(rig);
    data.d().ctrl[0] = 0.2;
    run(data, 200);
    return data.all();
  };
  EXPECT_EQ(ticks("noise_rad=0.01 seed=4"), ticks("noise_rad=0.01 seed=4"));
  EXPECT_NE(ticks("noise_rad=0.01 seed=4"), ticks("noise_rad=0.01 seed=5"));
}

TEST(Unit, ALinearOneDrivesASlideInMetres) {
  One one;
  one.joint = R"(type="slide")";
  one.config = config(key("equilibrium", "0.01"), "linear_sea_example");
  const Rig rig(mjcf_of(one));
  Data data(rig);
  data.d().ctrl[0] = 0.03;
  data.d().ctrl[1] = 2e4;  // N/m: a torque servo's preset is its stiffness
  run(data, 3000);
  EXPECT_NEAR(data.d().qpos[0], 0.03, 2e-3);
}

TEST(Unit, OfMotorVoltagesTakesThose) {
  const record::Scratch scratch;
  record::spew(
      scratch.path() / "volts.toml",
      "[type]\nname = \"volts\"\ntitle = \"volts\"\nbase = \"linear_sea_example\"\n[control]\nkind = \"motor_voltages\"\n");
  One one;
  one.joint = R"(type="slide")";
  one.config = config("", (scratch.path() / "volts.toml").string());
  one.actuators = R"(<plugin name="v" joint="elbow" plugin="vsasim.unit" instance="elbow"/>)";
  const Rig rig(mjcf_of(one));
  Data data(rig);
  data.d().ctrl[0] = 3;
  run(data, 100);
  EXPECT_GT(data.d().qpos[0], 0.001);
  EXPECT_GT(reading(data, Reading::current_1_A), 0.01);
}

TEST(Unit, AControlThatIsNoNumberLeavesTheCommandAsItIs) {
  const Rig rig(mjcf_of());
  Data data(rig), other(rig);
  data.d().ctrl[0] = other.d().ctrl[0] = 0.4;
  run(data, 500);
  run(other, 500);
  data.d().ctrl[0] = std::nan("");
  data.d().ctrl[1] = std::numeric_limits<double>::infinity();
  run(data, 500);
  run(other, 500);
  EXPECT_EQ(data.plugin_state(), other.plugin_state());
  EXPECT_EQ(data.d().qpos[0], other.d().qpos[0]);
}

TEST(Unit, ACommandBeyondItsRangeIsToldOnce) {
  const Rig rig(mjcf_of());
  Data data(rig);
  data.d().ctrl[1] = 40;
  run(data, 300);
  ASSERT_EQ(data.told.size(), 1u);
  EXPECT_NE(data.told.front().find("elbow"), std::string::npos) << data.told.front();
}

TEST(Unit, AnIntegratorThatAsksForTorquesInBetweenIsRefusedWhereItIsChosenLaterToo) {
  const Rig rig(mjcf_of());
  Data data(rig);
  run(data, 5);
  rig.model().opt.integrator = mjINT_RK4;
  EXPECT_THROW(data.step(), InputError);
  rig.model().opt.integrator = mjINT_IMPLICIT;
  EXPECT_NO_THROW(data.step());
}

TEST(Unit, AJointPutElsewhereIsntThrown) {
  // mj_resetDataKeyframe and programs set qpos after a reset: the units' first step begins there.
  One one;
  one.config = config(key("equilibrium", "0.3"));
  const Rig rig(mjcf_of(one));
  Data data(rig);
  data.d().qpos[0] = 0.3;
  data.d().ctrl[0] = 0.3;
  double fastest = 0;
  for (int k = 0; k < 200; ++k) {
    data.step();
    fastest = std::max(fastest, std::abs(data.d().qvel[0]));
  }
  EXPECT_LT(fastest, 0.05);
}

struct Wrong {
  const char* name;
  One one;
  const char* says;
};

One with(std::string config) {
  One out;
  out.config = std::move(config);
  return out;
}
One on(std::string joint) {
  One out;
  out.joint = std::move(joint);
  return out;
}
One acted(std::string actuators) {
  One out;
  out.actuators = std::move(actuators);
  return out;
}
One option(std::string text) {
  One out;
  out.option = std::move(text);
  return out;
}

const char* const kBoth = R"(<plugin name="e" joint="elbow" plugin="vsasim.unit" instance="elbow" X/>
                             <plugin name="p" joint="elbow" plugin="vsasim.unit" instance="elbow"/>)";
const char* const stateful = R"(<plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/>
                                <plugin joint="elbow" plugin="vsasim.unit" instance="elbow" dyntype="integrator"/>)";
std::string both(const std::string& more) {
  std::string out = kBoth;
  return out.replace(out.find('X'), 1, more);
}

One twice() {
  One out;
  out.more_instances = "<instance name=\"other\">" + out.config + "</instance>";
  out.actuators += R"(<plugin joint="elbow" plugin="vsasim.unit" instance="other"/>
                      <plugin joint="elbow" plugin="vsasim.unit" instance="other"/>)";
  return out;
}

class Refused : public testing::TestWithParam<Wrong> {};

TEST_P(Refused, WithOneReadableMessage) {
  try {
    const Rig rig(mjcf_of(GetParam().one));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(GetParam().says), std::string::npos) << text;
    EXPECT_NE(text.find("vsasim.unit"), std::string::npos) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Refused,
    testing::Values(Wrong{"UnknownType", with(config("", "qbmove_maker_por")), "did you mean qbmove_maker_pro"},
                    Wrong{"NoType", with(""), "type: is missing"},
                    Wrong{"NoSuchFile", with(config("", "none/x.toml")), "no such file"},
                    Wrong{"UnknownKey", with(config(key("override", "drive.wheels=4"))), "drive.wheels"},
                    Wrong{"NoOverride", with(config(key("override", "drive.supply_V"))), "override"},
                    Wrong{"ValueOutOfRange", with(config(key("override", "drive.supply_V=1e9"))), "drive.supply_V"},
                    Wrong{"NoNumber", with(config(key("preset", "much"))), "isn't a number"},
                    Wrong{"PresetTooLarge", with(config(key("preset", "7"))), "preset"},
                    Wrong{"EquilibriumTooFar", with(config(key("equilibrium", "9"))), "beyond the firmware's limits"},
                    Wrong{"BadId", with(config(key("id", "300"))), "1 … 254"},
                    Wrong{"BadBaud", with(config(key("baud", "12"))), "9600"},
                    Wrong{"BadCycle", with(config(key("cycle_s", "-1"))), "auto"},
                    Wrong{"CycleTooShort", with(config(key("cycle_s", "1e-6"))), "time on the wire"},
                    Wrong{"BadFault", with(config(key("faults", "sad"))), "sad"},
                    Wrong{"PresetOfATypeWithoutOne",
                          [] {
                            One out = with(config(key("preset", "0.1"), "sea_example"));
                            out.actuators = R"(<plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/>)";
                            return out;
                          }(),
                          "has no preset"},
                    Wrong{"NoPresetActuator", acted(R"(<plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/>)"),
                          "equilibrium, then preset"},
                    Wrong{"NoActuator", acted(R"(<motor joint="elbow"/>)"), "equilibrium, then preset"},
                    Wrong{"TwoInstancesOnAJoint", twice(), "elbow"},
                    Wrong{"TwoJoints", acted(R"(<plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/>
                       <plugin joint="wrist" plugin="vsasim.unit" instance="elbow"/>)"),
                          "isn't the joint of this instance's other actuator"},
                    Wrong{"Gear", acted(both("gear=\"2\"")), "has a gear of 2"},
                    Wrong{"ForceRange", acted(both("forcelimited=\"true\" forcerange=\"-1 1\"")), "forcerange"},
                    Wrong{"Dynamics", acted(stateful), "dyntype"}, Wrong{"Ball", on("type=\"ball\""), "is a ball joint"},
                    Wrong{"RotaryOnASlide", on("type=\"slide\""), "is prismatic"},
                    Wrong{"RungeKutta", option("timestep=\"0.001\" integrator=\"RK4\""), "RK4"},
                    Wrong{"LongStep", option("timestep=\"0.02\""), "0.016"}),
    [](const auto& of) { return std::string(of.param.name); });

TEST(Refused, LinesThatSayOtherwiseAboutThemselves) {
  One one = twice();
  one.config += key("bus", "arm") + key("baud", "460800");
  const std::string from = "<instance name=\"other\">", more = key("bus", "arm") + key("baud", "2000000");
  one.more_instances.insert(from.size(), more);
  try {
    const Rig rig(mjcf_of(one));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("another unit of this line says otherwise"), std::string::npos) << error.what();
  }
}

TEST(Units, TheirStateHasASizeBeforeThereAreUnits) {
  const Rig rig(mjcf_of());
  EXPECT_EQ(rig.units().state_size(),
            Units::state_size(std::vector{rig.units().unit(0).spec}, static_cast<std::size_t>(rig.model().nv)));
}

}  // namespace
}  // namespace vsa::mujoco::test
