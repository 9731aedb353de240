// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "sweep/columns.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/sweep/folder.hpp"

#ifdef VSA_HDF5
#include <hdf5.h>

#include "vsa/not_a_number.hpp"
#endif

namespace vsa::sweep {
namespace {

namespace fs = std::filesystem;

bool numeric(const Axis& axis) {
  return axis.kind != Axis::Kind::listed ||
         std::all_of(axis.values.begin(), axis.values.end(), [](const Value& v) { return v.index() < 2; });
}

}  // namespace

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::vector<Column> columns(const Plan& plan, const Results& results) {
  const std::size_t rows = plan.runs(), axes = plan.axes().size();
  std::vector<const Outcome*> of(rows, nullptr);
  for (const Outcome& o : results.outcomes)
    if (o.run < rows) of[o.run] = &o;
  std::vector<Column> out;
  const auto numbers = [&](const std::string& name) -> std::vector<double>& {
    out.push_back({name, true, std::vector<double>(rows, kNaN), {}});
    return out.back().numbers;
  };
  out.reserve(axes + plan.measures().size() + 4);
  std::vector<double>& point = numbers("point");
  std::vector<double>& repetition = numbers("repetition");
  for (const Axis& axis : plan.axes()) {
    const bool number = numeric(axis);
    out.push_back({axis.name, number, std::vector<double>(number ? rows : 0), std::vector<std::string>(number ? 0 : rows)});
  }
  for (const Measure& m : plan.measures()) numbers(m.name);
  out.push_back({"notice", false, {}, std::vector<std::string>(rows)});
  out.push_back({"error", false, {}, std::vector<std::string>(rows)});
  std::vector<Value> values;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t number = r / plan.repetitions();
    point[r] = static_cast<double>(number);
    repetition[r] = static_cast<double>(r % plan.repetitions());
    if (r % plan.repetitions() == 0) values = plan.values(number);
    for (std::size_t k = 0; k < axes; ++k) {
      Column& c = out[2 + k];
      if (c.is_number) {
        c.numbers[r] = number_of(values[k]);
      } else {
        c.texts[r] = value_text(values[k]);
      }
    }
    const Outcome* o = of[r];
    for (std::size_t m = 0; o != nullptr && m < o->values.size(); ++m) out[2 + axes + m].numbers[r] = o->values[m];
    out[out.size() - 2].texts[r] = o == nullptr ? "" : o->notice;
    out.back().texts[r] = o == nullptr ? "not run" : o->error;
  }
  return out;
}

std::string csv(const Plan& plan, const Results& results) {
  const std::vector<Column> all = columns(plan, results);
  std::string out;
  for (const Column& c : all) out += (out.empty() ? "" : ",") + cell(c.name);
  for (std::size_t r = 0; r < plan.runs(); ++r) {
    out += '\n';
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k > 0) out += ',';
      if (!all[k].is_number) {
        out += cell(all[k].texts[r]);
      } else if (const double v = all[k].numbers[r]; !std::isnan(v)) {
        out += std::isinf(v) ? (v > 0 ? "inf" : "-inf") : config::number_text(v);
      }
    }
  }
  return out + '\n';
}

#ifdef VSA_HDF5
bool has_hdf5() noexcept { return true; }

namespace {

/// A handle of HDF5's, closed by its own function. Throws OutputError where there is none.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), const fs::path& file) : id_(id), close_(closer) {
    if (id_ < 0) throw OutputError(file.string() + ": HDF5 can't write it");
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const noexcept { return id_; }  // NOLINT(google-explicit-constructor): where HDF5 wants one
  void close(const fs::path& file) {
    const herr_t closed = close_(id_);
    id_ = -1;
    if (closed < 0) throw OutputError(file.string() + ": HDF5 can't write it to its end");
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A dataset a column. No times in it: the same table has the same bytes.
void write_hdf5(const std::vector<Column>& all, std::size_t rows, const fs::path& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told here
  Handle out(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, file);
  const hsize_t size[1] = {rows};
  const Handle space(H5Screate_simple(1, size, nullptr), H5Sclose, file);
  const Handle timeless(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file);
  H5Pset_obj_track_times(timeless, false);
  const Handle intermediate(H5Pcreate(H5P_LINK_CREATE), H5Pclose, file);
  H5Pset_char_encoding(intermediate, H5T_CSET_UTF8);
  std::set<std::string> names;
  for (const Column& c : all) {
    std::string name = c.name;
    std::replace(name.begin(), name.end(), '/', '_');  // a group's sign
    while (!names.insert(name).second) name += '_';
    std::size_t longest = 1;
    for (const std::string& t : c.texts) longest = std::max(longest, t.size());
    const Handle text(H5Tcopy(H5T_C_S1), H5Tclose, file);
    H5Tset_size(text, longest);
    H5Tset_strpad(text, H5T_STR_NULLPAD);
    H5Tset_cset(text, H5T_CSET_UTF8);
    const hid_t type = c.is_number ? H5T_IEEE_F64LE : static_cast<hid_t>(text);
    const Handle data(H5Dcreate2(out, name.c_str(), type, space, intermediate, timeless, H5P_DEFAULT), H5Dclose, file);
    std::string flat(c.is_number ? 0 : rows * longest, '\0');
    for (std::size_t r = 0; !c.is_number && r < rows; ++r) c.texts[r].copy(&flat[r * longest], longest);
    const herr_t done = c.is_number ? H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, c.numbers.data())
                                    : H5Dwrite(data, text, H5S_ALL, H5S_ALL, H5P_DEFAULT, flat.data());
    if (done < 0) throw OutputError(file.string() + ": HDF5 can't write column " + c.name);
  }
  out.close(file);
}

}  // namespace
#else
bool has_hdf5() noexcept { return false; }
#endif

std::vector<fs::path> write_tables(const fs::path& folder, const Plan& plan, const Results& results) {
  std::vector<fs::path> out{folder / "results.csv"};
  write_whole(out.back(), csv(plan, results));
#ifdef VSA_HDF5
  out.push_back(folder / "results.h5");
  write_whole(out.back(), [&](const fs::path& file) { write_hdf5(columns(plan, results), plan.runs(), file); });
#endif
  return out;
}

}  // namespace vsa::sweep
