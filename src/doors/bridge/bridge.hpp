#pragma once
// Interface of the Python package, called by ctypes: plain C, so that one file serves every version of Python. Library
// and package are of one build; the interface is for this package only.
//
// A function has a name, takes JSON and gives JSON. Arrays go both ways as {"__array__": address, ...}
// (bridge/call.hpp); what a function has made, a case or a solution, stays with the call and is given to later ones by
// its address.
struct RailstrataCall;

extern "C" {
/// Calls a function. `arguments`: a JSON object. Nothing is thrown; what went wrong stands in the answer.
RailstrataCall* railstrata_call(const char* function, const char* arguments);
/// The same on a thread of its own, which solves with as many threads as this one would.
RailstrataCall* railstrata_begin(const char* function, const char* arguments);
/// Waits until the call has ended, this time at most: whether it has.
int railstrata_wait(RailstrataCall* call, int milliseconds);
/// Progress as a JSON list; null: none reported yet. The text holds until the next question.
const char* railstrata_progress(RailstrataCall* call);
/// Asks it to end soon.
void railstrata_stop(RailstrataCall* call);
/// Result of a call that has ended: a JSON object, {"fault": …} if it failed.
const char* railstrata_answer(const RailstrataCall* call);
/// Frees the call with all that it holds; one that is under way is stopped first.
void railstrata_forget(RailstrataCall* call);
}
