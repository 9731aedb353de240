// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every public function of vsa::engine with wrong sizes, numbers that are none, other worlds' objects and worlds that were moved
// from: an error in words, and nothing else. Worth most under the sanitizers (preset asan).
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <stdexcept>

#include "arm.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/output_file.hpp"
#include "vsa/seat/seat.hpp"

namespace vsa::engine::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBad[] = {kNan, kInfinity, -kInfinity, 1e300};

TEST(Hostile, LoadRefusesStepsAndFilesThatAreNone) {
  for (const double step_s : {kNan, kInfinity, -1.0, 0.0, 1e-9, 0.02, 1e300}) {
    WorldOptions options;
    options.step_s = step_s;
    EXPECT_THROW((void)World::load_string(arm(), options), InputError) << step_s;
  }
  EXPECT_THROW((void)World::load_string(""), InputError);
  EXPECT_THROW((void)World::load_string("<sdf"), InputError);
  EXPECT_THROW((void)World::load_string(std::string("\0\xff", 2)), InputError);
  EXPECT_THROW((void)World::load(""), InputError);
  EXPECT_THROW((void)World::load("/"), InputError);
  EXPECT_THROW((void)World::load("no such file.sdf"), InputError);
  EXPECT_EQ(World::load("bench_free").name(), World::load("bench_free.sdf").name());
  EXPECT_THROW((void)World::load_string(""), InputError);
}

TEST(Hostile, RunWantsATime) {
  World w = World::load_string(arm());
  for (const double bad : {kNan, kInfinity, -1.0, 1e300, 2e9}) EXPECT_THROW(w.run(bad), InputError) << bad;
  EXPECT_EQ(w.time_ns(), 0);
  w.run(0);
  EXPECT_EQ(w.time_ns(), 0);
  w.run(1e-12);
  EXPECT_EQ(w.time_ns(), 0) << "less than a nanosecond is none";
  w.run(0.0014);
  EXPECT_EQ(w.time_ns(), 2'000'000) << "a part of a step counts as one";
}

TEST(Hostile, SpansOfTheWrongSizeAreRefused) {
  World w = World::load_string(arm());
  const std::size_t n = w.dof_count(), links = w.links().size();
  std::vector<double> numbers(36 * n + 1);
  std::vector<Pose> poses(links + 1);
  const LinkHandle tip = w.link("arm::fore");
  for (const std::size_t wrong : {std::size_t{0}, n - 1, n + 1}) {
    EXPECT_THROW(w.bias_torques(std::span(numbers).first(wrong)), InputError);
    EXPECT_THROW(w.gravity_torques(std::span(numbers).first(wrong)), InputError);
    EXPECT_THROW(w.mass_matrix(std::span(numbers).first(wrong)), InputError);
    EXPECT_THROW(w.jacobian(tip, {}, std::span(numbers).first(wrong)), InputError);
  }
  EXPECT_THROW(w.poses({}), InputError);
  EXPECT_THROW(w.poses(std::span(poses).first(links - 1)), InputError);
  EXPECT_THROW(w.poses(poses), InputError);
}

TEST(Hostile, NumbersThatAreNoneAreRefusedAndTheWorldGoesOn) {
  World w = World::load_string(arm());
  World untouched = w.clone();
  const ActuatorRef& shoulder = w.actuator("shoulder");
  const LinkHandle tip = w.link("arm::fore");
  const JointHandle wrist = w.joint("arm::elbow");
  for (const double bad : kBad) {
    EXPECT_THROW(w.set_joint(wrist, bad, 0), InputError);
    EXPECT_THROW(w.set_joint("arm::elbow", 0, bad), InputError);
    EXPECT_THROW(w.place("shoulder", bad, 0.2), InputError);
    EXPECT_THROW(w.place("shoulder", 0, bad), InputError);
    EXPECT_THROW(w.place("shoulder", 0, 0.2, bad), InputError);
    EXPECT_THROW(w.place(shoulder, {0, 0.2, 0, bad}), InputError);
    EXPECT_THROW(w.apply_wrench(tip, {{bad, 0, 0}, {}, {}}), InputError);
    EXPECT_THROW(w.apply_wrench(tip, {{}, {0, bad, 0}, {}}), InputError);
    EXPECT_THROW(w.apply_wrench(tip, {{1, 0, 0}, {}, {0, 0, bad}}), InputError);
    EXPECT_THROW(w.apply_torque(wrist, bad), InputError);
    EXPECT_THROW(w.displace_model("ball", bad, {}), InputError);
    EXPECT_THROW(w.displace_model("ball", 0, {0, bad, 0}), InputError);
    std::vector<double> j(6 * w.dof_count());
    EXPECT_THROW(w.jacobian(tip, {bad, 0, 0}, j), InputError);
    Pull pull{tip.index()};
    pull.target_m[0] = bad;
    EXPECT_THROW(w.pull({pull}), InputError);
    if (!std::isfinite(bad)) {
      EXPECT_FALSE(w.command("shoulder", bad, 0.2));
      EXPECT_FALSE(w.command(shoulder, 0.2, bad));
    }
  }
  for (World* x : {&w, &untouched}) x->run(0.05);
  EXPECT_EQ(w.joint_angle(wrist), untouched.joint_angle(wrist));
}

TEST(Hostile, HugeNumbersEndInABlowUpThatIsTold) {
  World w = World::load_string(arm());
  const auto before = w.snapshot();
  w.apply_torque(w.joint("arm::elbow"), 1e9);
  EXPECT_THROW(w.run(1), SimulationError);
  w.apply_torque(w.joint("arm::elbow"), 0);
  w.restore(*before);
  w.apply_wrench(w.link("ball::l"), {{1e9, 0, 0}, {1e9, 0, 0}, {1e4, 0, 0}});
  EXPECT_THROW(w.run(1), SimulationError);
  w.reset();
  EXPECT_THROW(w.set_joint("arm::shoulder", 1e12, -1e12), InputError) << "beyond its limits";
  w.set_joint("arm::elbow", 1e12, -1e12);
  EXPECT_THROW(w.run(1), SimulationError);
  w.reset();
  EXPECT_NO_THROW(w.run(0.1));
}

TEST(Hostile, NamesThatNobodyHasAreRefused) {
  World w = World::load_string(arm());
  for (const std::string& name :
       {std::string{}, std::string("nobody"), std::string("arm::"), std::string("\0", 1), std::string(100'000, 'x')}) {
    EXPECT_THROW((void)w.actuator(name), InputError);
    EXPECT_THROW((void)w.command(name, 0, 0), InputError);
    EXPECT_THROW((void)w.read(name), InputError);
    EXPECT_THROW(w.place(name, 0, 0), InputError);
    EXPECT_THROW((void)w.joint(name), InputError);
    EXPECT_THROW((void)w.joint_angle(name), InputError);
    EXPECT_THROW((void)w.joint_speed(name), InputError);
    EXPECT_THROW(w.set_joint(name, 0, 0), InputError);
    EXPECT_THROW((void)w.link(name), InputError);
    EXPECT_THROW((void)w.center_of_mass(name), InputError);
    EXPECT_THROW(w.displace_model(name, 0, {}), InputError);
  }
  EXPECT_FALSE(JointInfo{}.one_axis());
  for (const JointInfo& joint : w.joints()) {
    if (!joint.one_axis()) {
      EXPECT_THROW((void)w.joint(joint.name), InputError) << joint.name;
    }
  }
  EXPECT_THROW((void)w.joint("arm::mount"), InputError) << "a fixed joint has no axis";
  EXPECT_THROW(w.displace_model("arm", 0, {}), InputError) << "is tied to the world";
}

TEST(Hostile, ObjectsOfAnotherWorldAreRefused) {
  World w = World::load_string(arm());
  World other = World::load_string(other_arm());
  for (const std::size_t i : {std::size_t{1}, std::size_t{9}, static_cast<std::size_t>(-1)}) {
    EXPECT_THROW((void)w.robot(i), InputError);
    EXPECT_THROW((void)std::as_const(w).robot(i), InputError);
    EXPECT_THROW((void)w.robot_model(i), InputError);
  }
  std::vector<ActuatorRef> refs{other.actuators().back(), {}, w.actuators().front(), w.actuators().front(), w.actuators().front()};
  refs[2].index = 99;
  refs[3].robot = 99;
  refs[4].name = "else";
  for (const ActuatorRef& ref : refs) {
    EXPECT_THROW((void)w.read(ref), InputError);
    EXPECT_THROW((void)w.command(ref, 0, 0), InputError);
    EXPECT_THROW(w.place(ref, {}), InputError);
    EXPECT_THROW((void)w.joint(ref), InputError);
    EXPECT_THROW((void)w.name_of(ref), InputError);
  }
  for (const JointHandle& joint : {JointHandle{}, other.joint("arm::wrist")}) {
    EXPECT_THROW((void)w.joint_angle(joint), InputError);
    EXPECT_THROW((void)w.joint_speed(joint), InputError);
    EXPECT_THROW(w.set_joint(joint, 0, 0), InputError);
    EXPECT_THROW(w.apply_torque(joint, 0), InputError);
  }
  std::vector<double> j(6 * w.dof_count());
  for (const LinkHandle& link : {LinkHandle{}, other.link("arm::hand")}) {
    EXPECT_THROW((void)w.pose(link), InputError);
    EXPECT_THROW((void)w.velocity(link), InputError);
    EXPECT_THROW((void)w.free_dof(link), InputError);
    EXPECT_THROW(w.apply_wrench(link, {}), InputError);
    EXPECT_THROW(w.jacobian(link, {}, j), InputError);
  }
  for (const LinkHandle& link : {LinkHandle{}, other.link("arm::hand")}) {
    EXPECT_THROW((void)w.link_parameters(link), InputError);
    EXPECT_THROW((void)w.link_parameters(*w.parameters(), link), InputError);
    EXPECT_THROW(w.set_link_parameters(link, {}), InputError);
    EXPECT_THROW((void)w.parameters_with(*w.parameters(), {{}, {{link, {}}}}), InputError);
  }
  for (const ActuatorRef& ref : refs) {
    EXPECT_THROW((void)w.actuator_parameters(*w.parameters(), ref), InputError);
    EXPECT_THROW((void)w.parameters_with(*w.parameters(), {{{ref, w.robot(0).config().actuators[0]}}, {}}), InputError);
  }
  for (const std::size_t i : {std::size_t{1}, static_cast<std::size_t>(-1)}) EXPECT_THROW((void)w.seat(i), InputError);
  EXPECT_THROW(w.apply_wrench(w.link("floor::l"), {{1, 0, 0}, {}, {}}), InputError) << "a static link";
  Pull pull;
  pull.link = 1'000'000;
  EXPECT_THROW(w.pull({pull}), InputError);
}

TEST(Hostile, SnapshotsOfAnotherWorldAreRefusedAndNothingChanged) {
  World w = World::load_string(arm());
  w.run(0.03);
  const double angle = w.joint_angle("arm::elbow");
  WorldOptions bare;
  bare.actuators = false;
  std::string renamed = arm(), heavier = arm();
  renamed.replace(renamed.find("name='fore'"), 11, "name='four'");
  renamed.replace(renamed.find("<child>fore"), 11, "<child>four");
  heavier.replace(heavier.find("<mass>0.2"), 9, "<mass>0.3");
  for (const World& other : {World::load_string(other_arm()), World::load_string(arm(), bare), World::load_string(renamed),
                             World::load_string(heavier), World::load_string(world(ground()))}) {
    EXPECT_THROW(w.restore(*other.snapshot()), InputError);
  }
  EXPECT_EQ(w.joint_angle("arm::elbow"), angle);
  EXPECT_EQ(w.time_ns(), 30'000'000);
}

// All but the last have the links, joints and actuators of arm() by name.
std::vector<World> worlds_like_arms() {
  std::string heavier = arm(), shaped = arm(), stopped = arm();
  heavier.replace(heavier.find("<mass>0.2"), 9, "<mass>0.3");
  const std::string shape = "<geometry><sphere><radius>0.01</radius></sphere></geometry>";
  shaped.replace(shaped.find("<link name='fore'>"), 18,
                 "<link name='fore'><collision name='a'>" + shape + "</collision><collision name='b'>" + shape + "</collision>");
  stopped.replace(stopped.find("<upper>2.5"), 10, "<upper>1.5");
  std::vector<World> out;
  for (const std::string& text : {heavier, shaped, stopped, arm("anydrive_ad119e20"), arm("sea_hardening_example"), other_arm()})
    out.push_back(World::load_string(text));
  WorldOptions bare;
  bare.actuators = false;
  out.push_back(World::load_string(arm(), bare));
  return out;
}

TEST(Hostile, ParametersOfAnotherWorldAreRefusedAndNothingChanged) {
  std::vector<World> all = worlds_like_arms();
  all.push_back(World::load_string(arm()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    World& w = all[i];
    w.run(0.03);
    World untouched = w.clone();
    const LinkHandle fore = w.link("arm::fore");
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k == i) continue;
      const auto theirs = all[k].parameters();
      EXPECT_THROW(w.set_parameters(*theirs), InputError) << i << " " << k;
      EXPECT_THROW(w.use(*theirs), InputError) << i << " " << k;
      EXPECT_THROW((void)w.parameters_with(*theirs, {}), InputError) << i << " " << k;
      EXPECT_THROW((void)w.link_parameters(*theirs, fore), InputError) << i << " " << k;
      if (w.actuators().empty()) continue;
      EXPECT_THROW((void)w.actuator_parameters(*theirs, w.actuators().front()), InputError) << i << " " << k;
    }
    for (World* x : {&w, &untouched}) x->run(0.03);
    EXPECT_EQ(w.state_hash(), untouched.state_hash()) << i;
  }
  World same = World::load_string(arm());
  EXPECT_NO_THROW(same.set_parameters(*all.back().parameters())) << "of the same file";
}

TEST(Hostile, LinksThatNoBodyCouldBeAreRefused) {
  World w = World::load_string(arm());
  const LinkHandle fore = w.link("arm::fore"), ground = w.link("floor::l");
  World untouched = w.clone();
  const LinkParameters now = w.link_parameters(fore);
  const auto refused = [&](LinkHandle link, auto&& spoil) {
    LinkParameters to = w.link_parameters(link);
    spoil(to);
    EXPECT_THROW(w.set_link_parameters(link, to), InputError);
    EXPECT_THROW((void)w.parameters_with(*w.parameters(), {{}, {{link, to}}}), InputError);
  };
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, -1.0}) {
    refused(fore, [&](LinkParameters& p) { p.mass_kg = bad; });
    refused(fore, [&](LinkParameters& p) { p.inertia_kgm2[1] = bad; });
    refused(fore, [&](LinkParameters& p) { p.friction = bad; });
    refused(ground, [&](LinkParameters& p) { p.mass_kg = bad; });
    refused(ground, [&](LinkParameters& p) { p.friction = bad; });
  }
  refused(fore, [](LinkParameters& p) { p.mass_kg = 0; });
  refused(fore, [](LinkParameters& p) { p.inertia_kgm2 = {1, 1, 3}; });
  refused(ground, [](LinkParameters& p) { p.friction = std::nullopt; });
  host::ActuatorConfig broken = w.robot(0).config().actuators[0];
  broken.unit.actuator.shaft_inertia_kgm2 = kNan;
  EXPECT_THROW((void)w.parameters_with(*w.parameters(), {{{w.actuators()[0], broken}}, {}}), InputError);
  broken.unit.actuator.transmission = nullptr;
  EXPECT_THROW((void)w.parameters_with(*w.parameters(), {{{w.actuators()[0], broken}}, {}}), InputError);
  EXPECT_EQ(w.link_parameters(fore), now);
  for (World* x : {&w, &untouched}) x->run(0.03);
  EXPECT_EQ(w.state_hash(), untouched.state_hash());
}

TEST(Hostile, NumbersThatAreNoStateOfThisWorldAreRefusedAndNothingChanged) {
  World w = World::load_string(arm());
  w.run(0.02);
  const std::size_t n = w.state_size();
  ASSERT_EQ(n, w.state_layout().size());
  const std::uint64_t hash = w.state_hash();
  std::vector<double> state(n), numbers(n + 1, kNan);
  w.save(state);
  for (const std::size_t wrong : {std::size_t{0}, n - 1, n + 1}) {
    EXPECT_THROW(w.save(std::span(numbers).first(wrong)), InputError);
    EXPECT_THROW(w.restore(std::span<const double>(numbers).first(wrong)), InputError);
  }
  EXPECT_THROW(w.restore(std::span<const double>(numbers).first(n)), InputError);
  const StateLayout layout = w.state_layout();
  for (const double bad : {kNan, 1e300}) {
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> spoiled = state;
      spoiled[k] = bad;
      try {
        w.restore(spoiled);
        w.restore(state);  // of a number that may be anything
        EXPECT_FALSE(layout.name_at(k).starts_with("physics/") || layout.name_at(k).starts_with("world.")) << layout.name_at(k);
      } catch (const InputError&) {
        EXPECT_EQ(w.state_hash(), hash) << layout.name_at(k);
      }
    }
  }
  EXPECT_EQ(w.state_hash(), hash);
}

TEST(Hostile, FilesThatHoldNoStateOfThisWorldAreRefused) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "vsa_hostile_files";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  World w = World::load_string(arm());
  w.run(0.02);
  const std::uint64_t hash = w.state_hash();
  for (const std::filesystem::path& bad : {std::filesystem::path(), std::filesystem::path("/"), folder, folder / "nobody" / "x"})
    EXPECT_THROW(w.save_file(bad), OutputError) << bad;
  World::load_string(other_arm()).save_file(folder / "other");
  std::ofstream(folder / "empty") << "";
  std::ofstream(folder / "text") << std::string(100'000, 'x');
  for (const std::filesystem::path& bad : {std::filesystem::path(), std::filesystem::path("/"), folder, folder / "nobody",
                                           folder / "other", folder / "empty", folder / "text"})
    EXPECT_THROW(w.restore_file(bad), InputError) << bad;
  EXPECT_EQ(w.state_hash(), hash);
  std::filesystem::remove_all(folder);
}

struct Commas : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

/// MuJoCo reads numbers as the program's global locale has them, and says only that there is none.
TEST(Hostile, AWorldRefusedForTheProgramsLocaleIsToldSo) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  std::string said;
  try {
    (void)World::load_string(
        R"(<mujoco><option timestep="0.002"/><worldbody><body><geom size="0.5"/></body></worldbody></mujoco>)");
  } catch (const InputError& error) {
    said = error.what();
  }
  std::locale::global(before);
  EXPECT_NE(said.find("MuJoCo refuses"), std::string::npos) << said;
  EXPECT_NE(said.find("decimal point of this program's global C++ locale is ','"), std::string::npos) << said;
}

TEST(Hostile, WorldsThatCannotBeExportedAreRefused) {
  for (const char* bad : {"", "/", "no such file.sdf", "no such file.xml"}) {
    EXPECT_THROW((void)export_mjcf(bad), InputError) << bad;
    EXPECT_THROW((void)export_plugin_mjcf(bad), InputError) << bad;
    static_cast<void>(mjcf_of(bad));
  }
  for (const char* mjcf : {"", "\n", "<mujoco model=\"", "<mujoco model=\"\">\n", "<!-- written of SDF "})
    EXPECT_FALSE(is_exported(mjcf)) << mjcf;
  for (const char* mjcf : {"<mujoco", "<else/>", "x"})
    EXPECT_THROW((void)export_plugin_mjcf("bench_free.sdf", {}, mjcf), InputError) << mjcf;
  std::vector<WorldOptions> of_no_file(4);
  of_no_file[0].step_s = kNan;
  of_no_file[1].step_s = 5e-4;
  of_no_file[2].actuators = false;
  of_no_file[3].actuator.type = "sea_example";
  for (const WorldOptions& options : of_no_file) EXPECT_THROW((void)export_mjcf("bench_free.sdf", options), InputError);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_THROW((void)export_plugin_mjcf("bench_free.sdf", of_no_file[i]), InputError) << i;
  EXPECT_NO_THROW((void)export_plugin_mjcf("bench_free.sdf", of_no_file[3])) << "the plug-in's actuators can be others";
}

TEST(Hostile, AWorldThatWasMovedFromSaysSo) {
  World full = World::load_string(arm());
  const auto snapshot = full.snapshot();
  const ActuatorRef ref = full.actuators().front();
  const JointHandle joint = full.joint("arm::elbow");
  const LinkHandle link = full.link("arm::fore");
  const auto parameters = full.parameters();
  const LinkParameters of_link = full.link_parameters(link);
  World taken = std::move(full);
  World& w = full;  // NOLINT(bugprone-use-after-move): that is what is tested
  std::vector<Contact> contacts;
  std::vector<double> numbers(36);
  const auto says_so = [](auto&& call) { EXPECT_THROW(static_cast<void>(call()), std::logic_error); };
  says_so([&] { return World(w.clone()).name(); });
  says_so([&] { return w.name(); });
  says_so([&] { return w.step_s(); });
  says_so([&] { return w.time_ns(); });
  says_so([&] { return w.time_s(); });
  says_so([&] { return w.step(), 0; });
  says_so([&] { return w.run(0), 0; });
  says_so([&] { return w.actuators().size(); });
  says_so([&] { return w.actuator("shoulder").index; });
  says_so([&] { return w.command("shoulder", 0, 0); });
  says_so([&] { return w.command(ref, 0, 0); });
  says_so([&] { return w.place("shoulder", 0, 0), 0; });
  says_so([&] { return w.place(ref, {}), 0; });
  says_so([&] { return w.read("shoulder").preset; });
  says_so([&] { return w.read(ref).preset; });
  says_so([&] { return w.robot_count(); });
  says_so([&] { return w.robot(0).size(); });
  says_so([&] { return std::as_const(w).robot(0).size(); });
  says_so([&] { return w.robot_model(0); });
  says_so([&] { return w.links().size(); });
  says_so([&] { return w.poses({}), 0; });
  says_so([&] { return w.center_of_mass("arm"); });
  says_so([&] { return w.joints().size(); });
  says_so([&] { return w.joint("arm::elbow"); });
  says_so([&] { return w.joint(ref); });
  says_so([&] { return w.link("arm::fore"); });
  says_so([&] { return w.joint_angle("arm::elbow"); });
  says_so([&] { return w.joint_angle(joint); });
  says_so([&] { return w.joint_speed("arm::elbow"); });
  says_so([&] { return w.joint_speed(joint); });
  says_so([&] { return w.set_joint("arm::elbow", 0, 0), 0; });
  says_so([&] { return w.set_joint(joint, 0, 0), 0; });
  says_so([&] { return w.pose(link); });
  says_so([&] { return w.velocity(link); });
  says_so([&] { return w.displace_model("ball", 0, {}), 0; });
  says_so([&] { return w.make_initial(), 0; });
  says_so([&] { return w.energy(); });
  says_so([&] { return w.ledger(); });
  says_so([&] { return w.contact_count(); });
  says_so([&] { return w.contacts(contacts), 0; });
  says_so([&] { return w.pull({}), 0; });
  says_so([&] { return w.pulls().size(); });
  says_so([&] { return w.apply_wrench(link, {}), 0; });
  says_so([&] { return w.apply_torque(joint, 0), 0; });
  says_so([&] { return w.dof_count(); });
  says_so([&] { return w.free_dof(link); });
  says_so([&] { return w.mass_matrix(numbers), 0; });
  says_so([&] { return w.bias_torques(numbers), 0; });
  says_so([&] { return w.gravity_torques(numbers), 0; });
  says_so([&] { return w.jacobian(link, {}, numbers), 0; });
  says_so([&] { return w.snapshot(); });
  says_so([&] { return w.restore(*snapshot), 0; });
  says_so([&] { return w.reset(), 0; });
  says_so([&] { return w.warnings().size(); });
  says_so([&] { return w.substeps(); });
  says_so([&] { return w.seat(0).model(); });
  says_so([&] { return w.body_energy(); });
  says_so([&] { return w.hands().size(); });
  says_so([&] { return w.types(); });
  says_so([&] { return w.link_parameters(link); });
  says_so([&] { return w.link_parameters(*parameters, link); });
  says_so([&] { return w.set_link_parameters(link, of_link), 0; });
  says_so([&] { return w.parameters(); });
  says_so([&] { return w.parameters_with(*parameters, {}); });
  says_so([&] { return w.actuator_parameters(*parameters, ref); });
  says_so([&] { return w.set_parameters(*parameters), 0; });
  says_so([&] { return w.use(*parameters), 0; });
  says_so([&] { return w.state_layout(); });
  says_so([&] { return w.state_size(); });
  says_so([&] { return w.save(numbers), 0; });
  says_so([&] { return w.restore(std::span<const double>(numbers)), 0; });
  says_so([&] { return w.state_hash(); });
  says_so([&] { return w.save_file("nowhere"), 0; });
  says_so([&] { return w.restore_file("nowhere"), 0; });
  EXPECT_TRUE(w.has_contacts() && w.has_hands()) << "of any world";
  w = std::move(taken);
  EXPECT_EQ(w.time_ns(), 0) << "and works again once it is given a world";
}

using motion::Gait;
using motion::GaitGroup;
using motion::GaitParams;
using motion::motion_time;
using motion::motion_value;
using motion::MotionParams;

GaitParams wave() {
  GaitParams params;
  params.frequency_rad_per_s = 3;
  params.groups.push_back({"g", {"shoulder"}, {1}, 0.2, 0.0, 1.0, 0.0, 0.2});
  return params;
}

TEST(Hostile, GaitsThatCannotBePlayedAreRefused) {
  const auto refused = [](auto&& spoil) {
    GaitParams params = wave();
    spoil(params);
    EXPECT_THROW(Gait{params}, InputError);
  };
  refused([](GaitParams& p) { p.period_ns = 0; });
  refused([](GaitParams& p) { p.period_ns = -5; });
  refused([](GaitParams& p) { p.frequency_rad_per_s = kNan; });
  refused([](GaitParams& p) { p.ramp_s = kInfinity; });
  refused([](GaitParams& p) { p.groups[0].n.clear(); });
  refused([](GaitParams& p) { p.groups[0].lambda = 0; });
  refused([](GaitParams& p) { p.groups[0].amplitude_rad = kNan; });
  refused([](GaitParams& p) { p.frequency_rad_per_s = 0, p.steering.emplace(); });
  EXPECT_THROW((void)Gait::load(""), InputError);
  Gait gait(wave());
  EXPECT_THROW((void)gait.equilibrium(gait.params().groups[0], 1, 0), InputError);
  EXPECT_THROW(gait.change({}, 0), InputError);
  EXPECT_THROW(gait.change({3, {{kNan, 0, 1, 0, 0}}}, 0), InputError);
  gait.change(gait.values(), kNan);
  GaitGroup stranger = wave().groups[0];
  stranger.name = "stranger";
  static_cast<void>(gait.equilibrium(stranger, 0, 0.1));
  EXPECT_FALSE(gait.leave("nobody", {true, true}));
  World other = World::load_string(world(ground()));
  EXPECT_THROW(gait.bind(other), InputError);
  EXPECT_THROW(gait.apply(other), InputError);
  World taken = std::move(other);
  EXPECT_THROW(gait.apply(other), std::logic_error);
}

TEST(Hostile, MotionsWithoutKeysOrTimeGiveNoNumberOrTheLast) {
  EXPECT_FALSE(motion_value({}, true, 0));
  EXPECT_FALSE(motion_value({}, false, kNan));
  EXPECT_EQ(motion_value({{0, 1}, {1, 2}}, true, kInfinity), 2);
  EXPECT_EQ(motion_value({{0, 1}, {0, 2}}, true, 0), 2);
  MotionParams motion;
  motion.loop_from_s = 0;
  static_cast<void>(motion_time(motion, 5));
  motion::SteeringState state;
  for (int i = 0; i < 3; ++i) motion::steer({}, state, {kNan, kNan}, 0, kNan, true);
}

}  // namespace
}  // namespace vsa::engine::testing
