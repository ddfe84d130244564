#include "bridge/call.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>

#include "record/json.hpp"

namespace railstrata::bridge {
namespace {

template <class T>
T* at_address(const Json& address) {
  return reinterpret_cast<T*>(address.get<std::uintptr_t>());
}

Json view_of(const void* data, const char* type, const std::vector<std::size_t>& shape) {
  return {{"__array__", reinterpret_cast<std::uintptr_t>(data)}, {"type", type}, {"shape", shape}};
}

}  // namespace

std::size_t Array::size() const {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

double double_of(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (value == "nan") return std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  if (value == "inf") return infinite;
  if (value == "-inf") return -infinite;
  throw WrongType("a number is wanted, not " + json_text(value));
}

std::vector<std::string> texts_of(const Json& list) {
  if (!list.is_array()) throw WrongType("a list of texts is wanted, not " + json_text(list));
  std::vector<std::string> out;
  for (const Json& one : list) {
    if (!one.is_string()) throw WrongType("a text is wanted, not " + json_text(one));
    out.push_back(one.get<std::string>());
  }
  return out;
}

Array array_of(const Json& value) {
  return {at_address<const double>(value.at("__array__")), value.at("shape").get<std::vector<std::size_t>>()};
}

Json diagnostics(const std::vector<Diagnostic>& all) {
  Json out = Json::array();
  for (const Diagnostic& d : all) out.push_back({d.message, d.remedy, d.where});
  return out;
}

const Json& Call::argument(const char* name) const {
  const auto found = arguments_.find(name);
  if (found == arguments_.end()) throw WrongType(std::string("the argument ") + name + " is missing");
  return *found;
}

bool Call::flag(const char* name) const {
  const Json& value = argument(name);
  if (!value.is_boolean()) throw WrongType(std::string(name) + ": True or False is wanted, not " + json_text(value));
  return value.get<bool>();
}

int Call::whole(const char* name) const {
  const Json& value = argument(name);
  if (!value.is_number_integer())
    throw WrongType(std::string(name) + ": a whole number is wanted, not " + json_text(value));
  const auto found = value.get<double>();
  if (std::abs(found) > std::numeric_limits<int>::max())
    throw std::invalid_argument(std::string(name) + ": " + json_text(value) + " is too large");
  return value.get<int>();
}

double Call::number(const char* name) const {
  try {
    return double_of(argument(name));
  } catch (const WrongType& e) {
    throw WrongType(std::string(name) + ": " + e.what());
  }
}

std::string Call::text(const char* name) const {
  const Json& value = argument(name);
  if (!value.is_string()) throw WrongType(std::string(name) + ": a text is wanted, not " + json_text(value));
  return value.get<std::string>();
}

std::shared_ptr<void> Call::made_before(const Json& value, const char* name, const std::type_info& type) {
  const auto made = value.is_number_unsigned() ? at_address<RailstrataCall>(value)->call.made() : Made{};
  if (made.type == nullptr || *made.type != type) throw WrongType(std::string(name) + ": another object is wanted");
  held_.push_back(made.object);
  return made.object;
}

Json Call::view(const double* data, const std::vector<std::size_t>& shape, const std::vector<std::size_t>& strides) {
  Json out = view_of(data, "<f8", shape);
  if (!strides.empty()) out["strides"] = strides;
  return out;
}

Json Call::view(const unsigned char* data, const std::vector<std::size_t>& shape) {
  return view_of(data, "|u1", shape);
}

Json Call::kept(std::vector<double> values, const std::vector<std::size_t>& shape) {
  const auto held = std::make_shared<std::vector<double>>(std::move(values));
  held_.push_back(held);
  return view(held->data(), shape);
}

void Call::report(const Json& how_far) {
  const std::lock_guard hold(lock_);
  reported_ = json_text(how_far);
}

std::string Call::reported() const {
  const std::lock_guard hold(lock_);
  return reported_;
}

}  // namespace railstrata::bridge
