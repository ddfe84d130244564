#include "bridge/bridge.hpp"

#include <chrono>
#include <exception>
#include <memory>
#include <new>

#include "bridge/call.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "record/json.hpp"

namespace railstrata::bridge {
namespace {

/// kind: a class of railstrata.errors, or one of Python's own.
Json fault(const char* kind, const std::string& text, const std::string& remedy = {},
           const std::vector<Diagnostic>& all = {}) {
  return {{"fault", {{"kind", kind}, {"text", text}, {"remedy", remedy}, {"diagnostics", diagnostics(all)}}}};
}

void work(RailstrataCall& running, const std::string& function) {
  std::string answer;
  try {
    functions().at(function)(running.call);
    answer = json_text(running.call.answer);
  } catch (...) {
    answer = json_text(fault_of(std::current_exception()));
  }
  const std::lock_guard hold(running.lock);
  running.answer = std::move(answer);
  running.ended = true;
  running.at_end.notify_all();
}

}  // namespace

Json fault_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const CaseError& e) {
    return fault("CaseError", e.what(), {}, e.diagnostics);
  } catch (const NumericalError& e) {
    return fault("NumericalError", e.what());
  } catch (const EnvironmentError& e) {
    return fault("MachineError", e.what(), e.remedy);
  } catch (const Interrupted& e) {
    return fault("KeyboardInterrupt", e.what());
  } catch (const WrongType& e) {
    return fault("TypeError", e.what());
  } catch (const std::invalid_argument& e) {
    return fault("ValueError", e.what());
  } catch (const std::out_of_range& e) {
    return fault("ValueError", e.what());
  } catch (const std::bad_alloc&) {
    return fault("MemoryError", "there is not enough memory");
  } catch (const std::exception& e) {
    return fault("RuntimeError", e.what());
  }
}

const Functions& functions() {
  static const Functions all = [] {
    Functions out;
    for (const auto& some : {case_functions(), contact_functions(), damage_functions(), folder_functions(),
                             half_space_functions(), material_functions(), job_functions(), sweep_functions()})
      out.insert(some.begin(), some.end());
    return out;
  }();
  return all;
}

}  // namespace railstrata::bridge

using railstrata::bridge::Json;

RailstrataCall* railstrata_call(const char* function, const char* arguments) {
  auto running = std::make_unique<RailstrataCall>(Json::parse(arguments));
  railstrata::bridge::work(*running, function);
  return running.release();
}

RailstrataCall* railstrata_begin(const char* function, const char* arguments) {
  auto running = std::make_unique<RailstrataCall>(Json::parse(arguments));
  const int threads = railstrata::max_threads();  // OpenMP counts them per thread
  running->thread = std::thread([at = running.get(), name = std::string(function), threads] {
    railstrata::set_threads(threads);
    railstrata::bridge::work(*at, name);
  });
  return running.release();
}

int railstrata_wait(RailstrataCall* call, int milliseconds) {
  std::unique_lock hold(call->lock);
  return call->at_end.wait_for(hold, std::chrono::milliseconds(milliseconds), [&] { return call->ended; }) ? 1 : 0;
}

const char* railstrata_progress(RailstrataCall* call) {
  call->progress = call->call.reported();
  return call->progress.empty() ? nullptr : call->progress.c_str();
}

void railstrata_stop(RailstrataCall* call) { call->call.control.stop = true; }

const char* railstrata_answer(const RailstrataCall* call) { return call->answer.c_str(); }

void railstrata_forget(RailstrataCall* call) {
  railstrata_stop(call);
  if (call->thread.joinable()) call->thread.join();
  delete call;
}
