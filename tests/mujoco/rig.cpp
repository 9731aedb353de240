// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "rig.hpp"

#include <tinyxml2.h>

#include <array>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>

namespace vsa::mujoco::test {
namespace {

using tinyxml2::XMLElement;

std::mutex compiling;  // mj_loadXML keeps its last model in a global

/// What a thread is stepping: MuJoCo 2.2.2's callbacks are of the process.
struct Under {
  Units* units = nullptr;
  std::span<const double> state;
};
thread_local Under under;

void control(const mjModel* m, mjData* d) {
  if (under.units != nullptr) under.units->compute(*m, *d, under.state);
}

mjtNum gain(const mjModel*, const mjData*, int) { return 0; }

mjtNum bias(const mjModel*, const mjData*, int actuator) {
  if (under.units == nullptr) return 0;
  for (std::size_t u = 0; u < under.units->size(); ++u)
    if (under.units->unit(u).actuators.front() == actuator) return under.units->torque(u);
  return 0;
}

void sense(const mjModel* m, mjData* d, int stage) {
  if (under.units == nullptr || stage != mjSTAGE_POS || m->nsensor == 0) return;
  under.units->observe(*d, under.state);
  for (int s = 0; s < m->nsensor; ++s)
    under.units->read(static_cast<std::size_t>(s), {d->sensordata + m->sensor_adr[s], kReadings});
}

void hang() {
  mjcb_control = control;
  mjcb_act_gain = gain;
  mjcb_act_bias = bias;
  mjcb_sensor = sense;
}

class Stepping {
 public:
  Stepping(Units& units, std::span<const double> state) { under = {&units, state}; }
  ~Stepping() { under = {}; }
  Stepping(const Stepping&) = delete;
  Stepping& operator=(const Stepping&) = delete;
};

std::string attribute(const XMLElement& e, const char* name) {
  const char* text = e.Attribute(name);
  return text == nullptr ? "" : text;
}

/// Takes the plug-in's elements out of the document, and puts a user actuator or sensor for each.
std::vector<Unit> take_units(XMLElement& root) {
  std::vector<Unit> units;
  std::map<std::string, std::size_t> index;
  for (XMLElement* e = root.FirstChildElement("extension"); e != nullptr; e = root.FirstChildElement("extension")) {
    for (XMLElement* i = e->FirstChildElement("plugin")->FirstChildElement("instance"); i; i = i->NextSiblingElement("instance")) {
      UnitSpec spec{attribute(*i, "name"), {}};
      for (XMLElement* c = i->FirstChildElement("config"); c; c = c->NextSiblingElement("config"))
        spec.said[attribute(*c, "key")] = attribute(*c, "value");
      index[spec.name] = units.size();
      units.push_back({std::move(spec), {}});
    }
    root.DeleteChild(e);
  }
  int id = 0;
  if (XMLElement* list = root.FirstChildElement("actuator")) {
    for (XMLElement* a = list->FirstChildElement(); a != nullptr; a = a->NextSiblingElement(), ++id) {
      if (std::string(a->Name()) != "plugin") continue;
      units[index.at(attribute(*a, "instance"))].actuators.push_back(id);
      a->SetName("general");
      a->DeleteAttribute("plugin");
      a->DeleteAttribute("instance");
      a->SetAttribute("gaintype", "user");
      a->SetAttribute("biastype", "user");
    }
  }
  if (XMLElement* list = root.FirstChildElement("sensor")) {
    for (XMLElement* s = list->FirstChildElement("plugin"); s != nullptr; s = s->NextSiblingElement()) {
      const std::string instance = attribute(*s, "instance");
      s->SetName("user");
      s->DeleteAttribute("plugin");
      s->DeleteAttribute("instance");
      s->SetAttribute("objtype", "joint");  // 2.2.2 wants one
      s->SetAttribute("objname", instance.c_str());
      s->SetAttribute("datatype", "real");
      s->SetAttribute("dim", static_cast<int>(kReadings));
      s->SetAttribute("needstage", "pos");
    }
  }
  return units;
}

mjModel* compiled(const std::string& xml, const std::vector<std::pair<std::string, std::string>>& files) {
  const std::lock_guard lock(compiling);
  hang();
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  const auto add = [&](const std::string& name, const std::string& bytes) {
#if mjVERSION_HEADER >= 300
    mj_addBufferVFS(vfs.get(), name.c_str(), bytes.data(), static_cast<int>(bytes.size()));
#else
    mj_makeEmptyFileVFS(vfs.get(), name.c_str(), static_cast<int>(bytes.size()));
    std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), name.c_str())], bytes.data(), bytes.size());
#endif
  };
  add("world.xml", xml);
  for (const auto& [name, bytes] : files) add(name, bytes);
  std::array<char, 1000> error{};
  mjModel* m = mj_loadXML("world.xml", vfs.get(), error.data(), static_cast<int>(error.size()));
  mj_freeLastXML();
  mj_deleteVFS(vfs.get());
  if (m == nullptr) throw std::runtime_error(error.data());
  return m;
}

}  // namespace

Rig::Rig(const std::string& mjcf, const std::vector<std::pair<std::string, std::string>>& files) {
  tinyxml2::XMLDocument document;
  if (document.Parse(mjcf.c_str()) != tinyxml2::XML_SUCCESS) throw std::runtime_error(document.ErrorStr());
  std::vector<Unit> units = take_units(*document.RootElement());
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  model_.reset(compiled(printer.CStr(), files));
  units_ = std::make_unique<Units>(*model_, std::move(units));
}

Data::Data(const Rig& rig)
    : rig_(&rig), data_(mj_makeData(&rig.model())), units_(rig.units().clone()), state_(rig.units().state_size()) {
  units_->report_to([this](const std::string& line) { told.push_back(line); });
  units_->reset(state_);
}

Data::Data(const Data& other)
    : rig_(other.rig_),
      data_(mj_copyData(nullptr, &other.rig_->model(), other.data_.get())),
      units_(rig_->units().clone()),
      state_(other.state_) {
  units_->report_to([this](const std::string& line) { told.push_back(line); });
  units_->copy_step(*other.units_);
}

std::span<const double> Data::sensor(std::size_t unit) const {
  return {data_->sensordata + rig_->model().sensor_adr[unit], kReadings};
}

void Data::key(int id) {
  mj_resetDataKeyframe(&rig_->model(), data_.get(), id);
  units_->reset(state_);
}

void Data::reset() {
  mj_resetData(&rig_->model(), data_.get());
  units_->reset(state_);
}

void Data::step() {
  const Stepping stepping(*units_, state_);
  mj_step(&rig_->model(), data_.get());
  units_->advance(rig_->model(), *data_, state_);
}

void Data::forward() {
  const Stepping stepping(*units_, state_);
  mj_forward(&rig_->model(), data_.get());
}

std::vector<double> Data::all() const {
  const mjModel& m = rig_->model();
  std::vector<double> out{data_->time};
  out.insert(out.end(), data_->qpos, data_->qpos + m.nq);
  out.insert(out.end(), data_->qvel, data_->qvel + m.nv);
  out.insert(out.end(), data_->qacc_warmstart, data_->qacc_warmstart + m.nv);
  out.insert(out.end(), data_->ctrl, data_->ctrl + m.nu);
  out.insert(out.end(), state_.begin(), state_.end());
  return out;
}

void Data::set_all(const std::vector<double>& all) {
  const mjModel& m = rig_->model();
  const double* from = all.data();
  data_->time = *from++;
  const auto take = [&](double* to, auto n) {
    std::copy_n(from, n, to);
    from += n;
  };
  take(data_->qpos, m.nq);
  take(data_->qvel, m.nv);
  take(data_->qacc_warmstart, m.nv);
  take(data_->ctrl, m.nu);
  std::copy_n(from, state_.size(), state_.begin());
}

std::string mjcf_of(const One& one) {
  return R"(<mujoco model="one"><compiler angle="radian"/><option )" + one.option +
         R"(/><extension><plugin plugin="vsasim.unit"><instance name="elbow">)" + one.config + "</instance>" + one.more_instances +
         R"(</plugin></extension><worldbody><body name="arm"><joint name="elbow" axis="0 1 0" )" + one.joint +
         R"(/><inertial pos="0 0 0" mass="0.2" diaginertia="0.002 0.002 0.002"/>
         <body name="hand"><joint name="wrist" axis="0 1 0"/><inertial pos="0.1 0 0" mass="0.05" diaginertia="1e-4 1e-4 1e-4"/></body>
         </body></worldbody><actuator>)" +
         one.actuators + R"(</actuator><sensor><plugin name="elbow" plugin="vsasim.unit" instance="elbow"/></sensor></mujoco>)";
}

}  // namespace vsa::mujoco::test
