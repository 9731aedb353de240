// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// modelDescription.xml.
#include <tinyxml2.h>

#include <cctype>
#include <set>

#include "vsa/config/text.hpp"
#include "vsa/fmu/instance.hpp"
#include "vsa/fmu_package/package.hpp"

namespace vsa::fmu {
namespace {

using config::number_text;

const char* word(bool value) { return value ? "true" : "false"; }

const char* word(Causality causality) {
  switch (causality) {
    case Causality::independent:
      return "independent";
    case Causality::parameter:
      return "parameter";
    case Causality::input:
      return "input";
    case Causality::output:
      return "output";
  }
  return "";
}

const char* word(Variability variability) {
  switch (variability) {
    case Variability::fixed:
      return "fixed";
    case Variability::tunable:
      return "tunable";
    case Variability::continuous:
      return "continuous";
  }
  return "";
}

/// The standard wants types and variables to have different names.
std::string words_type(const Variable& v) { return v.name + "_words"; }

class Writer {
 public:
  Writer(const Model& model, const PackagePlan& plan) : all_(model.variables()), model_(model), plan_(plan) {}

  std::string write(const std::string& token) {
    xml_.PushHeader(false, true);
    xml_.OpenElement("fmiModelDescription");
    attribute("fmiVersion", two() ? "2.0" : "3.0");
    attribute("modelName", plan_.name);
    attribute(two() ? "guid" : "instantiationToken", token);
    attribute("description", plan_.title);
    attribute("generationTool", "vsasim " VSA_VERSION);
    attribute("license", "Apache-2.0");
    attribute("variableNamingConvention", "structured");
    capabilities();
    units();
    types();
    categories();
    experiment();
    xml_.OpenElement("ModelVariables");
    for (std::size_t i = 0; i < all_.size(); ++i) two() ? variable_2(i) : variable_3(i);
    xml_.CloseElement();
    structure();
    xml_.CloseElement();
    return xml_.CStr();
  }

 private:
  [[nodiscard]] bool two() const { return plan_.version == Version::fmi2; }
  void attribute(const char* name, const std::string& value) { xml_.PushAttribute(name, value.c_str()); }

  void capabilities() {
    xml_.OpenElement("CoSimulation");
    attribute("modelIdentifier", identifier_of(plan_.name));
    attribute("canHandleVariableCommunicationStepSize", "true");
    attribute(two() ? "canGetAndSetFMUstate" : "canGetAndSetFMUState", "true");
    attribute(two() ? "canSerializeFMUstate" : "canSerializeFMUState", "true");
    const bool slopes = model_.has_derivatives();
    attribute(two() ? "providesDirectionalDerivative" : "providesDirectionalDerivatives", word(slopes));
    if (two()) attribute("canNotUseMemoryManagementFunctions", "true");
    if (!two()) attribute("providesAdjointDerivatives", word(slopes));
    xml_.CloseElement();
  }

  void units() {
    std::set<std::string> units;
    for (const Variable& v : all_)
      if (!v.unit.empty() && v.kind == Kind::real) units.insert(v.unit);
    if (units.empty()) return;
    xml_.OpenElement("UnitDefinitions");
    for (const std::string& unit : units) {
      xml_.OpenElement("Unit");
      attribute("name", unit);
      if (const auto base = base_units(unit)) {
        xml_.OpenElement("BaseUnit");
        for (const auto& [symbol, power] : *base)
          if (power != 0) attribute(symbol.c_str(), std::to_string(power));
        xml_.CloseElement();
      }
      xml_.CloseElement();
    }
    xml_.CloseElement();
  }

  void types() {
    bool open = false;
    for (const Variable& v : all_) {
      if (v.kind != Kind::enumeration) continue;
      if (!open) xml_.OpenElement("TypeDefinitions");
      open = true;
      xml_.OpenElement(two() ? "SimpleType" : "EnumerationType");
      attribute("name", words_type(v));
      if (two()) xml_.OpenElement("Enumeration");
      for (std::size_t i = 0; i < v.words.size(); ++i) {
        xml_.OpenElement("Item");
        attribute("name", v.words[i]);
        attribute("value", std::to_string(i + 1));
        xml_.CloseElement();
      }
      if (two()) xml_.CloseElement();
      xml_.CloseElement();
    }
    if (open) xml_.CloseElement();
  }

  void categories() {
    xml_.OpenElement("LogCategories");
    for (const char* name : {kLogInfo, kLogWarning, kLogError}) {
      xml_.OpenElement("Category");
      attribute("name", name);
      xml_.CloseElement();
    }
    xml_.CloseElement();
  }

  void experiment() {
    xml_.OpenElement("DefaultExperiment");
    attribute("startTime", "0");
    attribute("stopTime", "1");
    attribute("stepSize", number_text(plan_.step_s));
    xml_.CloseElement();
  }

  void common(std::size_t i) {
    const Variable& v = all_[i];
    attribute("name", v.name);
    attribute("valueReference", std::to_string(i));
    attribute("description", v.description + (v.kind == Kind::integer && !v.unit.empty() ? ", " + v.unit : ""));
    attribute("causality", word(v.causality));
    attribute("variability", word(v.variability));
    if (v.causality == Causality::parameter) attribute("initial", "exact");
    if (v.causality == Causality::output) attribute("initial", "calculated");
  }

  void value(const Variable& v) {
    if (!v.unit.empty() && v.kind == Kind::real) attribute("unit", v.unit);  // the standard's integers have none
    if (v.kind == Kind::enumeration) attribute("declaredType", words_type(v));
    if (v.min) attribute("min", number_text(*v.min));
    if (v.max) attribute("max", number_text(*v.max));
    if (v.causality != Causality::parameter && v.causality != Causality::input) return;
    attribute("start", v.kind == Kind::boolean ? word(v.start != 0) : number_text(v.start));
  }

  void variable_2(std::size_t i) {
    xml_.OpenElement("ScalarVariable");
    common(i);
    constexpr const char* kElements[] = {"Real", "Integer", "Boolean", "Enumeration"};
    xml_.OpenElement(kElements[static_cast<std::size_t>(all_[i].kind)]);
    value(all_[i]);
    xml_.CloseElement();
    xml_.CloseElement();
  }

  void variable_3(std::size_t i) {
    constexpr const char* kElements[] = {"Float64", "Int32", "Boolean", "Enumeration"};
    xml_.OpenElement(kElements[static_cast<std::size_t>(all_[i].kind)]);
    common(i);
    value(all_[i]);
    xml_.CloseElement();
  }

  /// FMI 2 counts variables from 1, FMI 3 goes by value references.
  [[nodiscard]] std::string place(std::size_t i) const { return std::to_string(two() ? i + 1 : i); }

  void unknown(const char* element, std::size_t i, bool with_dependencies) {
    xml_.OpenElement(element);
    attribute(two() ? "index" : "valueReference", place(i));
    std::string on;
    for (const Reference r : all_[i].depends_on) on += (on.empty() ? "" : " ") + place(r);
    if (with_dependencies) attribute("dependencies", on);
    xml_.CloseElement();
  }

  void structure() {
    xml_.OpenElement("ModelStructure");
    if (two()) xml_.OpenElement("Outputs");
    outputs(two() ? "Unknown" : "Output", true);
    if (two()) xml_.CloseElement();
    // At the start everything follows from everything.
    if (two()) xml_.OpenElement("InitialUnknowns");
    outputs(two() ? "Unknown" : "InitialUnknown", false);
    if (two()) xml_.CloseElement();
    xml_.CloseElement();
  }

  void outputs(const char* element, bool with_dependencies) {
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (all_[i].causality == Causality::output) unknown(element, i, with_dependencies);
  }

  const std::vector<Variable>& all_;
  const Model& model_;
  const PackagePlan& plan_;
  tinyxml2::XMLPrinter xml_;
};

}  // namespace

std::string identifier_of(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (out.empty() || std::isdigit(static_cast<unsigned char>(out.front())) != 0) out.insert(0, "fmu_");
  return out;
}

std::string model_description(const Model& model, const PackagePlan& plan, const std::string& token) {
  return Writer(model, plan).write(token);
}

}  // namespace vsa::fmu
