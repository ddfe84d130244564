// The functions of CONTACT's interface that are of module 1 alone.
#include <algorithm>
#include <string>

#include "cntc/calls.hpp"
#include "cntc/module_one.hpp"
#include "cntc/railstrata_cntc.h"

using namespace railstrata::cntc;

namespace {

/// Calls `work` with the wheel and the problem of its settings.
template <class Work>
void with_wheel(int ire, const char* call, Work&& work) noexcept {
  with_problem(ire, 0, call, [&](Problem& base) { work(registry().wheel(ire), base); });
}

template <class Work>
void set(int ire, Setting what, const char* call, Work&& work) noexcept {
  setting(ire, 0, static_cast<int>(what), call, [&](Problem& base) { work(registry().wheel(ire), base); });
}

template <class Work>
void get(int ire, const char* call, std::span<double> out, Work&& work) noexcept {
  copy_to(out, std::span<const double>());
  with_wheel(ire, call, [&](ModuleOne& one, Problem& base) { copy_to(out, work(one, base)); });
}

}  // namespace

extern "C" {

void cntc_setverticalforce(const int* ire, const double* fz) {
  set(*ire, Setting::normal, "cntc_setverticalforce",
      [&](ModuleOne& one, Problem& base) { set_vertical_force(one, base, *fz); });
}

void cntc_setprofileinputfname(const int* ire, const char* fname, const int* len_fname, const int* nints,
                               const int* iparam, const int* nreals, const double* rparam) {
  const std::string file = registry().in_work_folder(text(fname, len_fname));
  const bool wheel = profile_is_of_wheel(file, given(iparam, *nints));
  set(*ire, wheel ? Setting::wheel_profile : Setting::rail_profile, "cntc_setprofileinputfname",
      [&](ModuleOne& one, Problem& base) {
        set_profile(one, base, file, given(iparam, *nints), given(rparam, *nreals));
      });
}

void cntc_setprofileinputvalues(const int* ire, const int* npoint, const double* values, const int* nints,
                                const int* iparam, const int* nreals, const double* rparam) {
  const bool wheel = *nints < 1 || iparam[0] >= 1;
  set(*ire, wheel ? Setting::wheel_profile : Setting::rail_profile, "cntc_setprofileinputvalues",
      [&](ModuleOne& one, Problem& base) {
        set_profile(one, base, given(values, 2 * *npoint), given(iparam, *nints), given(rparam, *nreals));
      });
}

void cntc_settrackdimensions(const int* ire, const int* ztrack, const int* nparam, const double* rparam) {
  set(*ire, Setting::track, "cntc_settrackdimensions",
      [&](ModuleOne& one, Problem& base) { set_track(one, base, *ztrack, given(rparam, *nparam)); });
}

void cntc_setwheelsetdimensions(const int* ire, const int* ewheel, const int* nparam, const double* rparam) {
  set(*ire, Setting::wheelset, "cntc_setwheelsetdimensions",
      [&](ModuleOne& one, Problem& base) { set_wheelset(one, base, *ewheel, given(rparam, *nparam)); });
}

void cntc_setwheelsetposition(const int* ire, const int* ewheel, const int* nparam, const double* rparam) {
  set(*ire, Setting::position, "cntc_setwheelsetposition",
      [&](ModuleOne& one, Problem& base) { set_position(one, base, *ewheel, given(rparam, *nparam)); });
}

void cntc_setwheelsetvelocity(const int* ire, const int* ewheel, const int* nparam, const double* rparam) {
  set(*ire, Setting::velocity, "cntc_setwheelsetvelocity",
      [&](ModuleOne& one, Problem& base) { set_velocity(one, base, *ewheel, given(rparam, *nparam)); });
}

void cntc_setwheelsetflexibility(const int* ire, const int* ewheel, const int* nparam, const double* rparam) {
  set(*ire, Setting::flexibility, "cntc_setwheelsetflexibility",
      [&](ModuleOne& one, Problem& base) { set_flexibility(one, base, *ewheel, given(rparam, *nparam)); });
}

void cntc_getprofilevalues(const int* ire, const int* itask, const int* nints, const int* iparam, const int* nreals,
                           const double* rparam, const int* lenarr, double* values) {
  get(*ire, "cntc_getprofilevalues", given(values, *lenarr), [&](ModuleOne& one, Problem& base) {
    return profile_values(one, base, *itask, given(iparam, *nints), given(rparam, *nreals));
  });
}

void cntc_getprofilevalues_new(const int* ire, const int* itask, const int* nints, const int* iparam, const int* nreals,
                               const double* rparam, const int* lenarr, double* values) {
  cntc_getprofilevalues(ire, itask, nints, iparam, nreals, rparam, lenarr, values);
}

void cntc_getwheelsetposition(const int* ire, const int* lenarr, double* values) {
  get(*ire, "cntc_getwheelsetposition", given(values, *lenarr),
      [](ModuleOne& one, Problem& base) { return wheelset_motion(one.wheelset, base, false); });
}

void cntc_getwheelsetvelocity(const int* ire, const int* lenarr, double* values) {
  get(*ire, "cntc_getwheelsetvelocity", given(values, *lenarr),
      [](ModuleOne& one, Problem& base) { return wheelset_motion(one.wheelset, base, true); });
}

void cntc_getnumcontactpatches(const int* ire, int* npatch) {
  *npatch = -1;
  with_wheel(*ire, "cntc_getnumcontactpatches",
             [&](ModuleOne& one, Problem&) { *npatch = static_cast<int>(one.found.patches.size()); });
}

void cntc_getcontactlocation(const int* ire, const int* icp, const int* lenarr, double* values) {
  get(*ire, "cntc_getcontactlocation", given(values, *lenarr), [&](ModuleOne& one, Problem& base) {
    const Problem* patch = *icp >= 1 ? registry().find(*ire, *icp) : nullptr;
    return contact_location(one, base, patch ? *patch : base, patch ? *icp : 0);
  });
}

void cntc_getglobalforces(const int* ire, const int* icp, const int* lenarr, double* values) {
  get(*ire, "cntc_getglobalforces", given(values, *lenarr),
      [&](ModuleOne& one, Problem& base) { return global_forces(one, base, *icp); });
}

}  // extern "C"
