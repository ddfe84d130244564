#include "cntc/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace railstrata::cntc {
namespace {

std::string joined(std::string folder, const std::string& rest) {
  if (folder.empty() || (!rest.empty() && rest.front() == '/')) return rest;
  if (folder.back() != '/') folder += '/';
  return folder + rest;
}

bool in_range(int ire, int icp) { return ire >= 1 && ire <= kMostElements && icp >= 1 && icp <= kMostProblems; }

}  // namespace

void Registry::open(std::string_view wrkdir, std::string_view outdir, std::string_view name, MessageFile::To to) {
  const std::lock_guard lock(mutex_);
  if (open_) return;
  open_ = true;
  std::string folder{wrkdir}, experiment{name.empty() ? "contact_addon" : name};
  const std::size_t slash = experiment.find_last_of('/');
  if (slash != std::string::npos) {
    if (folder.empty()) folder = experiment.substr(0, slash + 1);
    experiment.erase(0, slash + 1);
  }
  work_folder_ = folder;
  const std::string out = outdir.empty() ? folder : joined(folder, std::string(outdir));
  messages_.set(joined(out, experiment + ".out"), to);
}

void Registry::make_element(int ire, int module) {
  if (ire < 1 || ire > kMostElements)
    throw Refused(kWrongProblem, fmt::format("ire = {} is not 1 to {}", ire, kMostElements));
  open({}, {}, {}, MessageFile::To::file);  // unless it was called for
  const std::lock_guard lock(mutex_);
  auto& element = elements_[static_cast<std::size_t>(ire)];
  if (!element) {
    element = std::make_unique<Element>();
    if (module == 1) element->wheel = std::make_unique<ModuleOne>();
  }
  if (module != 0 && (module == 1) != (element->wheel != nullptr))
    throw Refused(kWrongProblem, fmt::format("ire = {} is of the other module: call cntc_finalize first", ire));
}

Problem& Registry::problem(int ire, int icp) {
  const bool of_wheel = find_wheel(ire) != nullptr;
  if (of_wheel && icp < 1) icp = 0;
  if (!(of_wheel && icp == 0) && !in_range(ire, icp))
    throw Refused(kWrongProblem, fmt::format("ire = {}, icp = {}: ire is 1 to {} and icp 1 to {}, of module 1 also -1",
                                             ire, icp, kMostElements, kMostProblems));
  make_element(ire);
  const std::lock_guard lock(mutex_);
  auto& problem = elements_[static_cast<std::size_t>(ire)]->problems[static_cast<std::size_t>(icp)];
  if (!problem) {
    problem = std::make_unique<Problem>();
    problem->of_wheel = of_wheel;
  }
  return *problem;
}

ModuleOne* Registry::find_wheel(int ire) {
  if (ire < 1 || ire > kMostElements) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto& element = elements_[static_cast<std::size_t>(ire)];
  return element ? element->wheel.get() : nullptr;
}

ModuleOne& Registry::wheel(int ire) {
  ModuleOne* out = find_wheel(ire);
  if (!out) throw Refused(kWrongProblem, fmt::format("ire = {} is not of module 1: call cntc_initialize", ire));
  return *out;
}

std::string Registry::in_work_folder(std::string_view path) {
  const std::lock_guard lock(mutex_);
  return joined(work_folder_, std::string(path));
}

Problem* Registry::find(int ire, int icp) {
  if (!in_range(ire, icp)) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto& element = elements_[static_cast<std::size_t>(ire)];
  return element ? element->problems[static_cast<std::size_t>(icp)].get() : nullptr;
}

void Registry::remove(int ire) {
  bool empty = false;
  {
    const std::lock_guard lock(mutex_);
    if (ire >= 1 && ire <= kMostElements) elements_[static_cast<std::size_t>(ire)].reset();
    empty = std::all_of(elements_.begin(), elements_.end(), [](const auto& e) { return !e; });
  }
  if (empty) remove_all();
}

void Registry::remove_all() {
  const std::lock_guard lock(mutex_);
  for (auto& element : elements_) element.reset();
  open_ = false;
  last_ = {};
  messages_.close();
}

void Registry::report(int ire, int icp, Problem* problem, const char* call, int code, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);  // a second thread on a busy problem gets a report too
    if (problem) problem->last = {code, text};
    last_ = {code, text};
  }
  if (print_level < 1) return;
  const std::string where = icp >= 1 ? fmt::format("ire {}, icp {}", ire, icp) : fmt::format("ire {}", ire);
  messages_.write(code == 0 ? fmt::format("{}: {}: {}", where, call, text)
                            : fmt::format("{}: {}: error {}: {}", where, call, code, text));
}

void Registry::clear_message(Problem& problem) {
  const std::lock_guard lock(mutex_);
  problem.last = {};
}

Refusal Registry::last(int ire, int icp) {
  const Problem* problem = find(ire, icp);
  const std::lock_guard lock(mutex_);
  return problem ? problem->last : last_;
}

Registry& registry() {
  static Registry all;
  return all;
}

}  // namespace railstrata::cntc
