#pragma once
// The result elements and contact problems of a process, and where messages go.
#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "cntc/message_file.hpp"
#include "cntc/module_one.hpp"
#include "cntc/problem.hpp"

namespace railstrata::cntc {

class Registry {
 public:
  /// Folders and name as CONTACT takes them: outdir may be relative to wrkdir. The first call counts, until the last
  /// element is gone.
  void open(std::string_view wrkdir, std::string_view outdir, std::string_view name, MessageFile::To to);
  /// Makes a result element unless it exists. Throws Refused for a number out of range or another module.
  void make_element(int ire, int module = 0);
  /// Makes it too, of module 3. Throws Refused for numbers out of range. Of module 1 the problems are patches; icp
  /// below 1 has the settings of all.
  Problem& problem(int ire, int icp);
  /// Null where the element is of module 3; `wheel` throws Refused then.
  ModuleOne* find_wheel(int ire);
  ModuleOne& wheel(int ire);
  /// A path of a caller, relative to wrkdir.
  std::string in_work_folder(std::string_view path);
  /// Null where there is none.
  Problem* find(int ire, int icp);
  void remove(int ire);
  void remove_all();

  /// Keeps a message of a problem, or of the library, and writes it.
  void report(int ire, int icp, Problem* problem, const char* call, int code, const std::string& text);
  /// Clears the message of a problem that is solved anew.
  void clear_message(Problem& problem);
  Refusal last(int ire, int icp);

  int print_level = 1;
  int threads = 1;  ///< of one problem; -1: all

 private:
  struct Element {
    std::array<std::unique_ptr<Problem>, kMostProblems + 1> problems;  ///< 0: settings of module 1
    std::unique_ptr<ModuleOne> wheel;
  };
  std::mutex mutex_;
  std::array<std::unique_ptr<Element>, kMostElements + 1> elements_;
  bool open_ = false;
  std::string work_folder_;
  MessageFile messages_;
  Refusal last_;
};

Registry& registry();

}  // namespace railstrata::cntc
