// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/recorder.hpp"

#include <pybind11/stl/filesystem.h>

#include "vsa/errors.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

/// Samples its world's steps until it is finished or given up.
class PyRecorder {
 public:
  PyRecorder(std::shared_ptr<PyWorld> world, const std::filesystem::path& directory, record::RecorderOptions options)
      : world_(std::move(world)), recorder_(std::make_shared<record::Recorder>(world_->get(), directory, std::move(options))) {
    world_->attach(recorder_);
  }
  ~PyRecorder() {
    if (world_) world_->detach(recorder_);
  }
  PyRecorder(const PyRecorder&) = delete;
  PyRecorder& operator=(const PyRecorder&) = delete;

  using Page = std::optional<std::filesystem::path>;
  Page finish(const py::object& summary, const std::string& note) {
    if (finished_) return page_;
    std::vector<record::Statistic> statistics;
    if (!summary.is_none()) {
      for (const auto& [label, value] : dict_of(summary, "summary")) statistics.push_back({py::str(label), py::str(value)});
    }
    (void)world_->get();
    if (finished_) return page_;  // by another thread, while `summary` became texts
    world_->detach(recorder_);
    finished_ = true;
    auto page = recorder_->finish(statistics, note);
    if (!page.empty()) page_ = std::move(page);
    return page_;
  }

  void leave(const py::object& type, const py::object& value) {
    const bool ended_early = !type.is_none();
    finish(py::none(), ended_early ? std::string(py::str(type.attr("__name__"))) + ": " + std::string(py::str(value)) : "");
  }

  [[nodiscard]] const record::Recorder& get() const { return *recorder_; }

 private:
  std::shared_ptr<PyWorld> world_;
  PyWorld::Recorder recorder_;
  bool finished_ = false;
  Page page_;
};

constexpr const char* kRecord =
    "Records every step of this world from now on into CSV files, an MCAP file and a replay page in `directory`, as `vsa run\n"
    "--record` does; the present moment is its first sample. Where the world goes back (reset, restore) the files start over.\n"
    "rate_Hz: of the files; page_rate_Hz: of the page; title: the page's.\n"
    "Returns a Recorder: use it in a `with`, or call its finish(). InputError: what can't be written, or out of range.";

}  // namespace

void bind_recorder(py::module_& m, WorldClass& c) {
  py::class_<PyRecorder, std::shared_ptr<PyRecorder>>(
      m, "Recorder", "A recording under way; see World.record. As a context manager it is finished at the end of the block.")
      .def(
          "finish", &PyRecorder::finish, py::arg("summary") = py::none(), py::arg("note") = "",
          "Closes the files and writes the page, with `summary` (dict of label to value) and, if the run ended early, a `note` on\n"
          "why. Returns the page's path: pathlib.Path, or None without a page. Again: the same path. OutputError: disk full and "
          "such.")
      .def_property_readonly(
          "files", [](const PyRecorder& r) { return r.get().files(); }, "What is written besides the page: list of pathlib.Path.")
      .def_property_readonly(
          "without_page", [](const PyRecorder& r) { return r.get().without_page(); },
          "Why there will be no page, in a sentence: str; empty: there will be one.")
      .def("__enter__", [](const std::shared_ptr<PyRecorder>& r) { return r; })
      .def("__exit__",
           [](PyRecorder& r, const py::object& type, const py::object& value, const py::object&) { r.leave(type, value); });
  c.def(
      "record",
      [](const std::shared_ptr<PyWorld>& world, const std::filesystem::path& directory, double rate_Hz, double page_rate_Hz,
         const std::string& title) {
        record::RecorderOptions options;
        options.rate_Hz = rate_Hz;
        options.page_rate_Hz = page_rate_Hz;
        options.title = title;
        return std::make_shared<PyRecorder>(world, directory, std::move(options));
      },
      py::arg("directory"), py::kw_only(), py::arg("rate_Hz") = 100.0, py::arg("page_rate_Hz") = 50.0, py::arg("title") = "",
      kRecord);
}

}  // namespace vsa::python
