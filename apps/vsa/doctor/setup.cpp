// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Apart from the checks, which vsa-doctor has without CLI11.
#include <CLI/CLI.hpp>
#include <memory>

#include "doctor/doctor.hpp"
#include "vsa/sdf/feature.hpp"
#include "vsa/topics/feature.hpp"

namespace vsa::app {
namespace {

constexpr const char* kDoctorNotes = R"(ok: nothing to do. note: worth knowing. problem: something won't work.
Exit codes: 0 no problem, 1 a problem, 2 bad usage or no such world.

Examples:
  vsa doctor                     what Gazebo, topics and serial ports need, here and now
  vsa doctor snake_flat          and this world
  vsa doctor robot.sdf           elements of older plug-ins are written anew: docs/howto/migration.md)";

}  // namespace

void setup_doctor(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* sub = app.add_subcommand("doctor", "What is missing for Gazebo, topics and serial ports, or wrong with a world");
  sub->add_option("WORLD", options->world, "An SDF, URDF or MJCF file, or the name of a built-in world");
  sub->add_option("--devices", options->devices, "Where the machine's devices are")
      ->capture_default_str()
      ->check(CLI::ExistingDirectory);
  sub->footer(kDoctorNotes);
  sub->callback([options, &exit_code] {
    exit_code = run_doctor(*options, load_world,
                           {{VSA_MUJOCO_NAME, VSA_MUJOCO_FOUND_AS, VSA_MUJOCO_REMEDY},
                            reader::sdf_feature(),
                            reader::urdf_feature(),
                            topics::topics_feature(),
                            {VSA_PYTHON_NAME, VSA_PYTHON_FOUND_AS, VSA_PYTHON_REMEDY},
                            {VSA_HDF5_NAME, VSA_HDF5_FOUND_AS, VSA_HDF5_REMEDY},
                            {VSA_PAGMO_NAME, VSA_PAGMO_FOUND_AS, VSA_PAGMO_REMEDY},
                            {VSA_MPI_NAME, VSA_MPI_FOUND_AS, VSA_MPI_REMEDY}});
  });
}

}  // namespace vsa::app
