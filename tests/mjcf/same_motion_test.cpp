// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world from SDF and the same from the MJCF that was written of it: the same to the last bit, in motion and in what is recorded.
#include <gtest/gtest.h>

#include <algorithm>

#include "../record/scratch.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;
using record::Scratch;
using record::slurp;

const fs::path kWorlds = fs::path(VSA_SOURCE_DIR) / "models/worlds";

void write(const std::vector<ExportedFile>& files, const fs::path& to) {
  for (const ExportedFile& file : files) record::spew(to / file.name, file.bytes);
}

/// Moves it and records; the state at the end.
std::vector<double> recorded(World& world, const std::string& gait_name, double duration_s, const fs::path& to) {
  record::Recorder recorder(world, to);
  std::optional<motion::Gait> gait;
  if (!gait_name.empty()) gait = motion::Gait::load(config::find_file(gait_name, "gait", "models/gaits", ".toml"));
  if (!gait) world.command(world.actuators().front(), 0.4, 0.2);
  while (world.time_s() < duration_s) {
    if (gait) gait->apply(world);
    world.step();
    recorder.sample(world);
  }
  (void)recorder.finish();
  std::vector<double> state(world.state_size());
  world.save(state);
  return state;
}

void expect_same_scene(const World& a, const World& b) {
  ASSERT_EQ(a.links().size(), b.links().size());
  for (std::size_t l = 0; l < a.links().size(); ++l) {
    const LinkInfo &x = a.links()[l], &y = b.links()[l];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.model, y.model);
    EXPECT_EQ(x.mass_kg, y.mass_kg) << x.name;
    EXPECT_EQ(x.is_static, y.is_static) << x.name;
    ASSERT_EQ(x.visuals.size(), y.visuals.size()) << x.name;
    for (std::size_t v = 0; v < x.visuals.size(); ++v) {
      EXPECT_EQ(x.visuals[v].kind, y.visuals[v].kind) << x.name;
      EXPECT_EQ(x.visuals[v].pose.position, y.visuals[v].pose.position) << x.name;
      EXPECT_EQ(x.visuals[v].rgba, y.visuals[v].rgba) << x.name;
      EXPECT_EQ(x.visuals[v].vertices.size(), y.visuals[v].vertices.size()) << x.name;
      EXPECT_EQ(x.visuals[v].indices, y.visuals[v].indices) << x.name;
    }
  }
}

void expect_same_joints(const World& a, const World& b) {
  ASSERT_EQ(a.joints().size(), b.joints().size());
  for (std::size_t j = 0; j < a.joints().size(); ++j) {
    const JointInfo &x = a.joints()[j], &y = b.joints()[j];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.type, y.type) << x.name;
    EXPECT_EQ(x.range, y.range) << x.name;
    EXPECT_EQ(x.damping, y.damping) << x.name;
    EXPECT_EQ(x.dof, y.dof) << x.name;
    EXPECT_EQ(x.actuator, y.actuator) << x.name;
  }
}

struct Case {
  const char *world, *gait;
  double duration_s;
};

class FromSdfAndFromMjcf : public testing::TestWithParam<Case> {};

TEST_P(FromSdfAndFromMjcf, IsTheSameToTheLastBit) {
  const auto& [name, gait, duration_s] = GetParam();
  const Scratch scratch;
  write(export_mjcf(kWorlds / (std::string(name) + ".sdf")), scratch.path());
  World sdf = World::load(kWorlds / (std::string(name) + ".sdf"));
  World mjcf = World::load(scratch.path() / (std::string(name) + ".xml"));
  EXPECT_TRUE(mjcf.warnings().empty());
  EXPECT_EQ(sdf.name(), mjcf.name());
  EXPECT_EQ(sdf.step_s(), mjcf.step_s());
  expect_same_scene(sdf, mjcf);
  expect_same_joints(sdf, mjcf);
  EXPECT_EQ(recorded(sdf, gait, duration_s, scratch.path() / "sdf"), recorded(mjcf, gait, duration_s, scratch.path() / "mjcf"));
  std::size_t tables = 0;
  for (const auto& entry : fs::directory_iterator(scratch.path() / "sdf")) {
    if (entry.path().extension() != ".csv") continue;
    ++tables;
    EXPECT_TRUE(slurp(entry.path()) == slurp(scratch.path() / "mjcf" / entry.path().filename())) << entry.path().filename();
  }
  EXPECT_GT(tables, 0u);
}

INSTANTIATE_TEST_SUITE_P(Worlds, FromSdfAndFromMjcf,
                         testing::Values(Case{"bench_load", "", 0.5}, Case{"snake_rubble", "climb", 1.0},
                                         Case{"snake_hills", "sidewind", 0.5}, Case{"frank", "frank_wave", 1.0},
                                         Case{"frank_table", "frank_grasp", 0.5}, Case{"manipulator_3r", "manipulator_3r", 1.0},
                                         Case{"gripper_soft", "", 0.5}, Case{"bench_throw", "", 0.3}),
                         [](const auto& of) { return std::string(of.param.world); });

TEST(CommittedMjcf, IsWhatTheCommandWrites) {
  for (const std::string& name : config::built_in_files("models/worlds", ".sdf")) {
    for (const ExportedFile& file : export_mjcf(kWorlds / (name + ".sdf"))) {
      EXPECT_TRUE(slurp(kWorlds / file.name) == file.bytes)
          << file.name << " differs: run vsa export --mjcf " << name << " --out models/worlds";
    }
  }
}

TEST(Export, KeepsLinksWithoutGravity) {
  const Scratch scratch;
  const auto link = [](const std::string& name, const std::string& more) {
    return "<link name='" + name +
           "'><inertial><pose>0.1 0 0 0 0 0</pose><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01"
           "</izz></inertia></inertial>" +
           more + "</link>";
  };
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name='to_" + child + "' type='revolute'><parent>" + parent + "</parent><child>" + child +
           "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  };
  record::spew(
      scratch.path() / "w.sdf",
      "<sdf version='1.9'><world name='w'><model name='m'>" + link("a", "<gravity>false</gravity>") + link("b", "") +
          joint("world", "a") + joint("a", "b") +
          "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator><joint>to_b</joint><type>qbmove_maker_pro_6_1</type>"
          "<bus id='1'>arm</bus></actuator><bus name='arm' baud='2000000' cycle_s='auto'/></plugin></model></world></sdf>");
  fs::create_directory(scratch.path() / "out");
  write(export_mjcf(scratch.path() / "w.sdf"), scratch.path() / "out");
  World sdf = World::load(scratch.path() / "w.sdf"), mjcf = World::load(scratch.path() / "out/w.xml");
  for (World* w : {&sdf, &mjcf}) w->run(0.2);
  EXPECT_EQ(sdf.state_hash(), mjcf.state_hash());
  std::vector<double> torques(sdf.dof_count());
  sdf.reset();
  sdf.gravity_torques(torques);
  EXPECT_NEAR(std::abs(torques[sdf.joints()[0].dof.value()]), 0.1 * 9.8, 1e-12);  // of b alone
  const std::string plugin = export_plugin_mjcf(scratch.path() / "w.sdf").file.bytes;
  EXPECT_NE(plugin.find("<body name=\"m::a\" gravcomp=\"1\""), std::string::npos) << plugin;
  EXPECT_EQ(plugin.find("<body name=\"m::b\" gravcomp"), std::string::npos) << plugin;
}

TEST(Export, KeepsFrictionWithADirection) {
  const Scratch scratch;
  const auto model = [](const std::string& name, const std::string& more, const std::string& shape, const std::string& mu2) {
    return "<model name='" + name + "'>" + more + "<link name='l'><inertial><mass>2</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy>" +
           "<izz>0.02</izz></inertia></inertial><collision name='c'><pose>0 0 0 0 0 0.3</pose><geometry>" + shape +
           "</geometry><surface><friction><ode><mu>0.3</mu><mu2>" + mu2 + "</mu2><fdir1>1 2 0</fdir1></ode></friction></surface>" +
           "</collision></link></model>";
  };
  const std::string plane = "<plane><normal>0 0 1</normal><size>9 9</size></plane>", box = "<box><size>0.4 0.4 0.2</size></box>";
  record::spew(scratch.path() / "w.sdf", "<sdf version='1.9'><world name='w'><gravity>3 1 -9</gravity>" +
                                             model("ground", "<static>true</static><pose>0 0 0 0 0 0.2</pose>", plane, "0.7") +
                                             model("box", "<pose>0 0 0.1 0 0 0.1</pose>", box, "0.1") +
                                             model("table", "<static>true</static><pose>0 5 0 0 0 0.4</pose>", box, "0.2") +
                                             model("on_it", "<pose>0 5 0.2 0 0 0</pose>", box, "0.8") + "</world></sdf>");
  fs::create_directory(scratch.path() / "out");
  write(export_mjcf(scratch.path() / "w.sdf"), scratch.path() / "out");
  World sdf = World::load(scratch.path() / "w.sdf"), mjcf = World::load(scratch.path() / "out/w.xml");
  const std::uint64_t begun = sdf.state_hash();
  for (World* w : {&sdf, &mjcf}) w->run(0.2);
  EXPECT_EQ(sdf.state_hash(), mjcf.state_hash());
  EXPECT_NE(sdf.state_hash(), begun);
  const std::string beside = slurp(scratch.path() / "out/w.vsa.xml");
  for (const char* geom : {"ground", "box", "table", "on_it"})
    EXPECT_NE(beside.find("<friction geom=\"" + std::string(geom) + "::l/collision[c]\" mu=\"0.3\""), std::string::npos) << beside;
}

TEST(Export, TellsThePluginsReaderThatFrictionHadADirectionOfAnMjcfToo) {
  const Scratch scratch;
  const std::string unit = "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>";
  record::spew(scratch.path() / "w.sdf",
               "<sdf version='1.9'><world name='w'><model name='m'><link name='a'>" + unit +
                   "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry><surface><friction><ode><mu>0.3"
                   "</mu><mu2>0.7</mu2><fdir1>1 2 0</fdir1></ode></friction></surface></collision></link><joint name='j' "
                   "type='revolute'><parent>world</parent><child>a</child><axis><xyz>0 1 0</xyz></axis></joint><plugin "
                   "name='vsa::Robot' filename='libvsa-robot.so'><actuator><joint>j</joint><type>qbmove_maker_pro_6_1</type><bus "
                   "id='1'>arm</bus></actuator><bus name='arm'/></plugin></model></world></sdf>");
  write(export_mjcf(scratch.path() / "w.sdf"), scratch.path());
  const std::vector<std::string> of_sdf = export_plugin_mjcf(scratch.path() / "w.sdf").notes;
  ASSERT_EQ(of_sdf.size(), 1u);
  EXPECT_NE(of_sdf[0].find("<fdir1> isn't told to MuJoCo"), std::string::npos) << of_sdf[0];
  EXPECT_EQ(export_plugin_mjcf(scratch.path() / "w.xml").notes, of_sdf);
}

/// A linkage askew in the world, closed by a joint of that type; its crank is driven.
std::string looped(const std::string& type) {
  const auto link = [](const std::string& name, const std::string& pose) {
    return "<link name='" + name + "'><pose>" + pose +
           "</pose><inertial><pose>0.05 0.02 0 0 0 0</pose><mass>0.3</mass><inertia><ixx>0.001</ixx><iyy>0.002</iyy><izz>0.002"
           "</izz></inertia></inertial></link>";
  };
  const auto joint = [](const std::string& name, const std::string& kind, const std::string& ends, const std::string& of_axis) {
    return "<joint name='" + name + "' type='" + kind + "'>" + ends +
           (kind == "revolute" ? "<axis><xyz>0 1 0</xyz>" + of_axis + "</axis>" : "") + "</joint>";
  };
  const std::string damped = "<dynamics><damping>0.01</damping></dynamics>";
  return "<sdf version='1.9'><world name='w'><model name='m'><pose>0.1 0.2 1 0.3 -0.2 0.7</pose>" + link("a", "0 0 0 0 0 0") +
         link("b", "0 0 0.1 0 0.2 0") + link("c", "0.3 0 0.1 0 0.1 0") +
         joint("o", "revolute", "<parent>world</parent><child>a</child>", damped) +
         joint("j", "revolute", "<parent>a</parent><child>b</child>", damped) +
         joint("k", type, "<parent>b</parent><child>c</child>", "") +
         joint("p", "revolute", "<pose>0 0 -0.1 0 -0.1 0</pose><parent>world</parent><child>c</child>", damped) +
         "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator><joint>o</joint><type>qbmove_maker_pro_6_1</type>"
         "<bus id='1'>arm</bus></actuator><bus name='arm' baud='2000000' cycle_s='auto'/></plugin></model></world></sdf>";
}

TEST(Export, KeepsWhatClosesLoops) {
  for (const char* type : {"revolute", "ball", "fixed"}) {
    const Scratch scratch;
    record::spew(scratch.path() / "w.sdf", looped(type));
    fs::create_directory(scratch.path() / "out");
    write(export_mjcf(scratch.path() / "w.sdf"), scratch.path() / "out");
    World sdf = World::load(scratch.path() / "w.sdf"), mjcf = World::load(scratch.path() / "out/w.xml");
    expect_same_joints(sdf, mjcf);
    for (World* w : {&sdf, &mjcf}) {
      EXPECT_TRUE(w->joints()[2].closes_loop) << type;
      w->command(w->actuators().front(), 0.3, 0.4);
      w->run(0.3);
    }
    EXPECT_EQ(sdf.state_hash(), mjcf.state_hash()) << type;
    EXPECT_NO_THROW(mjcf.restore(*sdf.snapshot())) << type;
  }
}

TEST(Export, HasRoomForTheRowsOfAllItsLoops) {
  const Scratch scratch;
  constexpr int kMany = 40;
  std::string all = looped("revolute");
  const std::size_t from = all.find("<model"), to = all.find("<plugin");
  const std::string model = all.substr(from, to - from) + "</model>";
  for (int i = 0; i < kMany; ++i) {
    std::string one = model;
    one.replace(one.find("'m'"), 3, "'m" + std::to_string(i) + "'");
    all.replace(all.find("</world>"), 0, one);
  }
  record::spew(scratch.path() / "w.sdf", all);
  const std::string mjcf = export_mjcf(scratch.path() / "w.sdf").front().bytes;
  const std::size_t at = mjcf.find("njmax=\"");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GE(std::stoi(mjcf.substr(at + 7)), 6 * (kMany + 1)) << "what plain MuJoCo has: it leaves out constraints beyond";
}

/// The warnings of NAME.sdf that speak of its MJCF.
std::size_t told_of_mjcf(const fs::path& sdf) {
  const World world = World::load(sdf);
  return static_cast<std::size_t>(std::count_if(world.warnings().begin(), world.warnings().end(), [](const std::string& text) {
    return text.find("vsa export --mjcf writes it anew") != std::string::npos;
  }));
}

TEST(Export, TellsWhenItsSdfHasChangedSince) {
  const Scratch scratch;
  const auto part = [](const char* mass, const char* more = "") {
    return "<sdf version='1.7'><model name='part'><link name='l'><inertial><mass>" + std::string(mass) +
           "</mass></inertial></link>" + more + "</model></sdf>\n";
  };
  const std::string world = "<sdf version='1.7'><world name='w'><include><uri>part</uri></include></world></sdf>\n";
  const fs::path sdf = scratch.path() / "w.sdf";
  fs::create_directories(scratch.path() / "part");
  record::spew(sdf, world);
  record::spew(scratch.path() / "part/model.sdf", part("1"));
  record::spew(scratch.path() / "part/model.config", "<model><sdf version='1.7'>model.sdf</sdf></model>");
  EXPECT_EQ(told_of_mjcf(sdf), 0u) << "nothing beside it";
  write(export_mjcf(sdf), scratch.path());
  const std::string exported = slurp(scratch.path() / "w.xml");
  EXPECT_EQ(exported.find(scratch.path().string()), std::string::npos);
  EXPECT_EQ(told_of_mjcf(sdf), 0u);
  record::spew(scratch.path() / "part/model.sdf", part("1", "<!-- a word -->"));
  EXPECT_EQ(told_of_mjcf(sdf), 0u) << "comments move nothing";
  record::spew(scratch.path() / "part/model.sdf", part("2"));
  EXPECT_EQ(told_of_mjcf(sdf), 1u) << "what it includes counts";
  record::spew(scratch.path() / "part/model.sdf", part("1"));
  EXPECT_EQ(told_of_mjcf(sdf), 0u);
  record::spew(scratch.path() / "w.xml", "<mujoco/>\n");
  EXPECT_EQ(told_of_mjcf(sdf), 0u) << "one without a mark is somebody's own";
  const Scratch elsewhere;
  fs::copy(scratch.path(), elsewhere.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  EXPECT_EQ(export_mjcf(elsewhere.path() / "w.sdf").front().bytes, exported) << "wherever it lies";
}

TEST(Export, TellsSoOfAModelThatNamesWhatIsNotThere) {
  const Scratch scratch;
  const fs::path sdf = scratch.path() / "w.sdf", media = scratch.path() / "media";
  // Gazebo's own colours stand so in many models; nobody reads the script, so whether it is there makes no other mark.
  const auto box = [](const char* mass, const char* mesh) {
    return "<sdf version='1.7'><world name='w'><model name='m'><link name='l'><inertial><mass>" + std::string(mass) +
           "</mass></inertial><visual name='v'><geometry>" + mesh +
           "</geometry><material><script><uri>file://media/gazebo.material</uri><name>Gazebo/Red</name></script></material></"
           "visual>"
           "</link></model></world></sdf>\n";
  };
  const char* const cube = "<box><size>1 1 1</size></box>";
  record::spew(sdf, box("1", cube));
  write(export_mjcf(sdf), scratch.path());
  EXPECT_EQ(told_of_mjcf(sdf), 0u);
  const std::string exported = slurp(scratch.path() / "w.xml");
  record::spew(sdf, box("2", cube));
  EXPECT_EQ(told_of_mjcf(sdf), 1u);
  record::spew(sdf, box("1", cube));
  EXPECT_EQ(told_of_mjcf(sdf), 0u);
  fs::create_directories(media);
  record::spew(media / "gazebo.material", "material Gazebo/Red {}\n");
  EXPECT_EQ(told_of_mjcf(sdf), 0u);
  EXPECT_EQ(export_mjcf(sdf).front().bytes, exported);
  record::spew(sdf, box("1", "<mesh><uri>file://media/nowhere.stl</uri></mesh>"));
  EXPECT_EQ(told_of_mjcf(sdf), 1u);
}

TEST(Export, GoesBetweenSnapshots) {
  const Scratch scratch;
  write(export_mjcf(kWorlds / "frank.sdf"), scratch.path());
  World sdf = World::load(kWorlds / "frank.sdf"), mjcf = World::load(scratch.path() / "frank.xml");
  sdf.run(0.1);
  mjcf.restore(*sdf.snapshot());
  sdf.run(0.1);
  mjcf.run(0.1);
  EXPECT_EQ(sdf.state_hash(), mjcf.state_hash());
}

TEST(Export, WritesNamesThatXmlWouldTakeForItsOwn) {
  const Scratch scratch;
  record::spew(scratch.path() / "odd.sdf", R"(<sdf version="1.7"><world name="a &amp; b"><model name="m &lt;1&gt;">
    <link name="base &quot;x&quot;"/><link name="arm"/><joint name="j &amp; k" type="revolute"><parent>base &quot;x&quot;</parent><child>arm</child>
    <axis><xyz>0 0 1</xyz></axis></joint></model></world></sdf>)");
  write(export_mjcf(scratch.path() / "odd.sdf"), scratch.path());
  const World world = World::load(scratch.path() / "odd.xml");
  EXPECT_EQ(world.name(), "a & b");
  EXPECT_EQ(world.links().front().name, "m <1>::base \"x\"");
  EXPECT_EQ(world.joints().front().name, "m <1>::j & k");
}

TEST(Export, OfAnMjcfIsRefused) {
  EXPECT_NE(record::message_of<InputError>([] { (void)export_mjcf(kWorlds / "frank.xml"); }).find("is MJCF already"),
            std::string::npos);
}

}  // namespace
}  // namespace vsa::engine
