#pragma once
// A call as the functions of the bridge see it: arguments by name, an answer, and what the caller may look at while it
// lasts. Numbers that JSON lacks travel as texts: "inf", "-inf", "nan".
#include <condition_variable>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <typeinfo>
#include <vector>

#include "core/control.hpp"
#include "core/faults.hpp"

namespace railstrata::bridge {

using Json = nlohmann::ordered_json;

/// An argument is of the wrong kind.
struct WrongType : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something that a call has made and later ones take.
struct Made {
  std::shared_ptr<void> object;
  const std::type_info* type = nullptr;
};

/// Numbers of the caller's, or of an answer; they are not copied.
struct Array {
  const double* data = nullptr;
  std::vector<std::size_t> shape;
  std::size_t size() const;
  std::span<const double> all() const { return {data, size()}; }
};

Json number(double value);
std::vector<std::string> texts_of(const Json& list);
double double_of(const Json& value);
Array array_of(const Json& value);
/// A thrown exception as an answer: "fault", with the class of railstrata.errors or of Python that it is.
Json fault_of(const std::exception_ptr& thrown);
/// A list of (message, remedy, where).
Json diagnostics(const std::vector<Diagnostic>& all);

class Call {
 public:
  explicit Call(Json arguments) : arguments_(std::move(arguments)) {}

  // what is asked
  const Json& argument(const char* name) const;
  bool flag(const char* name) const;
  int whole(const char* name) const;
  double number(const char* name) const;
  std::string text(const char* name) const;
  std::vector<std::string> texts(const char* name) const { return texts_of(argument(name)); }
  Array array(const char* name) const { return array_of(argument(name)); }
  /// Object made by an earlier call; kept alive by this call as well.
  template <class T>
  std::shared_ptr<T> made(const char* name) {
    return std::static_pointer_cast<T>(made_before(argument(name), name, typeid(T)));
  }
  /// The same of a list.
  template <class T>
  std::vector<std::shared_ptr<T>> made_list(const char* name) {
    std::vector<std::shared_ptr<T>> out;
    for (const Json& one : argument(name))
      out.push_back(std::static_pointer_cast<T>(made_before(one, name, typeid(T))));
    return out;
  }

  // what is answered
  Json answer = Json::object();
  template <class T>
  void make(std::shared_ptr<T> object) {
    made_ = {std::move(object), &typeid(T)};
  }
  const Made& made() const { return made_; }
  /// A view of numbers that this call, what it has made or an argument holds. strides: bytes, empty for an array in one
  /// piece.
  static Json view(const double* data, const std::vector<std::size_t>& shape, const std::vector<std::size_t>& strides);
  static Json view(const double* data, const std::vector<std::size_t>& shape) { return view(data, shape, {}); }
  static Json view(const unsigned char* data, const std::vector<std::size_t>& shape);
  /// A view of numbers that the call keeps.
  Json kept(std::vector<double> values, const std::vector<std::size_t>& shape);

  // while it lasts
  Control control;
  /// Progress, for the caller's progress function.
  void report(const Json& how_far);
  std::string reported() const;

 private:
  std::shared_ptr<void> made_before(const Json& value, const char* name, const std::type_info& type);
  Json arguments_;
  std::vector<std::shared_ptr<void>> held_;
  Made made_;
  mutable std::mutex lock_;
  std::string reported_;
};

// The functions that the bridge offers, by name.

using Functions = std::map<std::string, void (*)(Call&)>;

/// All of them.
const Functions& functions();

// Functions of the bridge, one list for each source file.
Functions case_functions();
Functions contact_functions();
Functions damage_functions();
Functions folder_functions();
Functions half_space_functions();
Functions material_functions();
Functions job_functions();
Functions sweep_functions();

}  // namespace railstrata::bridge

/// A call with its thread.
struct RailstrataCall {
  explicit RailstrataCall(railstrata::bridge::Json arguments) : call(std::move(arguments)) {}
  railstrata::bridge::Call call;
  std::string answer;    ///< once it has ended
  std::string progress;  ///< the last one that was asked for
  std::mutex lock;
  std::condition_variable at_end;
  bool ended = false;
  std::thread thread;
};
