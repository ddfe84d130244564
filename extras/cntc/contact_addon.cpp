// The functions of CONTACT's library interface.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "cntc/blocks.hpp"
#include "cntc/calculate.hpp"
#include "cntc/calls.hpp"
#include "cntc/flags.hpp"
#include "cntc/railstrata_cntc.h"
#include "cntc/results.hpp"
#include "cntc/settings.hpp"

using namespace railstrata::cntc;

namespace {

int open(const int* output, std::string_view wrkdir, std::string_view outdir, std::string_view name) noexcept {
  return guarded(0, 0, nullptr, "cntc_initializefirst", [&] {
    const int to = output ? *output : 0;
    using To = MessageFile::To;
    registry().open(wrkdir, outdir, name, to == 0 ? To::file : to == 1 ? To::file_and_screen : To::nowhere);
  });
}

template <class Work>
void set(const int* ire, const int* icp, Setting what, const char* call, Work&& work) noexcept {
  setting(*ire, *icp, static_cast<int>(what), call, work);
}

/// Results of `work`, an array, to `out`: NaN first.
template <class Work>
void get(const int* ire, const int* icp, const char* call, std::span<double> out, Work&& work) noexcept {
  std::fill(out.begin(), out.end(), kNoNumber);
  with_problem(*ire, *icp, call, [&](Problem& problem) { copy_to(out, work(problem)); });
}

void get_field(const int* ire, const int* icp, const char* call, int number, int length, double* out) noexcept {
  get(ire, icp, call, given(out, length), [&](Problem& p) { return field(p, number); });
}

/// Three numbers of an array to three arguments.
template <class Numbers>
void scatter(const Numbers& from, double* a, double* b, double* c) {
  *a = from[0];
  *b = from[1];
  *c = from[2];
}

void set_global_flag(int code, int value) {
  if (code == kThreads) registry().threads = value;
  if (code == kPrintLevel) registry().print_level = value;
}

bool is_global(int code) { return code >= kPrintLevel && code <= kTimers && code != kWriteInput; }

}  // namespace

extern "C" {

// ------------------------------------------------------------------------------------------------------ begin and end

void cntc_initializefirst(int* ifcver, int* ierror, const int* ioutput, const char* wrkdir, const char* outdir,
                          const char* expnam, const int* len_wrkdir, const int* len_outdir, const int* len_expnam) {
  *ifcver = kInterfaceVersion;
  *ierror = open(ioutput, text(wrkdir, len_wrkdir), text(outdir, len_outdir), text(expnam, len_expnam));
}

void cntc_initializefirst_new(int* ifcver, int* ierror, const int* ioutput, const char* wrkdir, const char* outdir,
                              const char* expnam, const int* len_wrkdir, const int* len_outdir, const int* len_expnam) {
  cntc_initializefirst(ifcver, ierror, ioutput, wrkdir, outdir, expnam, len_wrkdir, len_outdir, len_expnam);
}

void cntc_initialize(const int* ire, const int* imodul, int* ifcver, int* ierror, const char* outdir,
                     const int* len_outdir) {
  *ifcver = kInterfaceVersion;
  *ierror = open(nullptr, {}, text(outdir, len_outdir), {});
  if (*ierror != 0) return;
  *ierror = guarded(*ire, -1, nullptr, "cntc_initialize", [&] {
    if (*imodul != 1 && *imodul != 3)
      throw Refused(kOther,
                    fmt::format("module {} is not offered: 1 (wheel on rail) and 3 (basic contact) are", *imodul));
    registry().make_element(*ire, *imodul);
  });
}

void cntc_finalize(const int* ire) {
  guarded(*ire, -1, nullptr, "cntc_finalize", [&] { registry().remove(*ire); });
}

void cntc_finalizelast(void) {
  guarded(0, -1, nullptr, "cntc_finalizelast", [] { registry().remove_all(); });
}

void cntc_setglobalflags(const int* lenflg, const int* params, const int* values) {
  for (int k = 0; k < *lenflg; ++k) set_global_flag(params[k], values[k]);
}

void cntc_setfileunits(const int*, const int*) {}

void cntc_getmaxnumthreads(int* mxthrd) { *mxthrd = omp_get_num_procs(); }

void cntc_readinpfile(const int* ire, const int*, const char*, const int*, int* ierror) {
  *ierror = guarded(*ire, -1, nullptr, "cntc_readinpfile",
                    [] { throw Refused(kInputFile, "input files are not read: set the problem by calls"); });
}

// ------------------------------------------------------------------------------------------------------------ settings

void cntc_setflags(const int* ire, const int* icp, const int* lenflg, const int* params, const int* values) {
  for (int k = 0; k < *lenflg; ++k) {
    if (params[k] == 0) continue;
    if (is_global(params[k])) {
      set_global_flag(params[k], values[k]);
      continue;
    }
    setting(*ire, *icp, params[k], "cntc_setflags", [&](Problem& p) {
      const std::string remark = set_flag(p, params[k], values[k]);
      if (!remark.empty()) registry().report(*ire, *icp, &p, "cntc_setflags", 0, remark);
    });
  }
}

void cntc_setmetadata(const int* ire, const int* icp, const int*, const int*, const double*) {
  with_problem(*ire, *icp, "cntc_setmetadata", [&](Problem& p) {
    registry().report(*ire, *icp, &p, "cntc_setmetadata", 0, "has no effect: no .mat file is written");
  });
}

void cntc_setsolverflags(const int* ire, const int* icp, const int* gdigit, const int* nints, const int* iparam,
                         const int* nreals, const double* rparam) {
  set(ire, icp, Setting::solver, "cntc_setsolverflags",
      [&](Problem& p) { set_solver(p, *gdigit, given(iparam, *nints), given(rparam, *nreals)); });
}

void cntc_setmaterialparameters(const int* ire, const int* icp, const int* mdigit, const int* nparam,
                                const double* rparam) {
  set(ire, icp, Setting::material, "cntc_setmaterialparameters",
      [&](Problem& p) { set_materials(p, *mdigit, given(rparam, *nparam)); });
}

void cntc_settemperaturedata(const int* ire, const int* icp, const int* imeth, const int* nparam,
                             const double* rparam) {
  set(ire, icp, Setting::temperature, "cntc_settemperaturedata",
      [&](Problem& p) { set_heat(p, *imeth, given(rparam, *nparam)); });
}

void cntc_settimestep(const int* ire, const int* icp, const double*) {
  with_problem(*ire, *icp, "cntc_settimestep", [&](Problem& p) {
    registry().report(*ire, *icp, &p, "cntc_settimestep", 0, "has no effect: nothing here depends on time in a shift");
  });
}

void cntc_setreferencevelocity(const int* ire, const int* icp, const double* veloc) {
  set(ire, icp, Setting::speed, "cntc_setreferencevelocity", [&](Problem& p) { set_speed(p, *veloc); });
}

void cntc_setrollingstepsize(const int* ire, const int* icp, const double* chi, const double* dq) {
  set(ire, icp, Setting::step, "cntc_setrollingstepsize", [&](Problem& p) {
    if (ModuleOne* wheel = registry().find_wheel(*ire))
      set_relative_step(*wheel, *dq);
    else
      set_rolling_step(p, *chi, *dq);
  });
}

void cntc_setfrictionmethod(const int* ire, const int* icp, const int* imeth, const int* nparam, const double* params) {
  set(ire, icp, Setting::friction, "cntc_setfrictionmethod", [&](Problem& p) {
    ModuleOne* wheel = registry().find_wheel(*ire);
    const std::string remark = wheel ? set_wheel_friction(*wheel, p, *imeth, given(params, *nparam))
                                     : set_friction(p, *imeth, given(params, *nparam));
    if (!remark.empty()) registry().report(*ire, *icp, &p, "cntc_setfrictionmethod", 0, remark);
  });
}

void cntc_sethertzcontact(const int* ire, const int* icp, const int* ipotcn, const int* nparam, const double* rparam) {
  set(ire, icp, Setting::grid, "cntc_sethertzcontact",
      [&](Problem& p) { set_hertz(p, *ipotcn, given(rparam, *nparam)); });
}

void cntc_setpotcontact(const int* ire, const int* icp, const int* ipotcn, const int* nparam, const double* rparam) {
  set(ire, icp, Setting::grid, "cntc_setpotcontact", [&](Problem& p) {
    if (ModuleOne* wheel = registry().find_wheel(*ire))
      set_search(*wheel, p, *ipotcn, given(rparam, *nparam));
    else
      set_potential_contact(p, *ipotcn, given(rparam, *nparam));
  });
}

void cntc_setpenetration(const int* ire, const int* icp, const double* pen) {
  set(ire, icp, Setting::normal, "cntc_setpenetration", [&](Problem& p) { set_approach(p, *pen); });
}

void cntc_setnormalforce(const int* ire, const int* icp, const double* fn) {
  set(ire, icp, Setting::normal, "cntc_setnormalforce", [&](Problem& p) { set_load(p, *fn); });
}

void cntc_setundeformeddistc(const int* ire, const int* icp, const int* ibase, const int* nparam,
                             const double* prmudf) {
  set(ire, icp, Setting::gap, "cntc_setundeformeddistc",
      [&](Problem& p) { set_gap(p, *ibase, given(prmudf, *nparam)); });
}

void cntc_setcreepages(const int* ire, const int* icp, const double* vx, const double* vy, const double* phi) {
  set(ire, icp, Setting::creepages, "cntc_setcreepages", [&](Problem& p) { set_creepages(p, *vx, *vy, *phi); });
}

void cntc_setextrarigidslip(const int* ire, const int* icp, const int* lenarr, const double* wx, const double* wy) {
  set(ire, icp, Setting::slip, "cntc_setextrarigidslip",
      [&](Problem& p) { set_extra_slip(p, given(wx, *lenarr), given(wy, *lenarr)); });
}

void cntc_settangentialforces(const int* ire, const int* icp, const double* fx, const double* fy) {
  set(ire, icp, Setting::forces, "cntc_settangentialforces", [&](Problem& p) {
    if (ModuleOne* wheel = registry().find_wheel(*ire))
      set_force_along(*wheel, *fx);
    else
      set_forces(p, *fx, *fy);
  });
}

void subs_addblock(const int* ire, const int* icp, const int* iblk, const int* isubs, const int* nx, const int* ny,
                   const int* nz, const double* xparam, const double* yparam, const double* zparam) {
  set(ire, icp, Setting::blocks, "subs_addblock", [&](Problem& p) {
    add_block(p, {*iblk, *isubs, given(xparam, *nx), given(yparam, *ny), given(zparam, *nz)});
  });
}

void rscntc_setlayers(const int* ire, const int* icp, const int* body, const int* n, const double* thickness,
                      const double* young, const double* poisson) {
  set(ire, icp, Setting::layers, "rscntc_setlayers",
      [&](Problem& p) { set_layers(p, *body, *n, given(thickness, *n), given(young, *n), given(poisson, *n)); });
}

// ----------------------------------------------------------------------------------------------------------- solutions

void cntc_calculate(const int* ire, const int* icp, int* ierror) { *ierror = calculate(*ire, *icp); }

void subs_calculate(const int* ire, const int* icp, int* ierror) { *ierror = calculate_blocks(*ire, *icp); }

// ------------------------------------------------------------------------------------------------------------- results

void cntc_getflags(const int* ire, const int* icp, const int* nparam, const int* iparam, int* values) {
  const auto out = given(values, *nparam);
  std::fill(out.begin(), out.end(), -1);
  with_problem(*ire, *icp, "cntc_getflags", [&](Problem& p) {
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = get_flag(p, iparam[k]);
  });
}

void cntc_getparameters(const int* ire, const int* icp, const int* itask, const int* lenarr, double* values) {
  get(ire, icp, "cntc_getparameters", given(values, *lenarr), [&](Problem& p) { return parameters(p, *itask); });
}

void cntc_getreferencevelocity(const int* ire, const int* icp, double* veloc) {
  get(ire, icp, "cntc_getreferencevelocity", given(veloc, 1),
      [](Problem& p) { return std::array{p.settings.speed / p.units.length}; });
}

void cntc_gethertzcontact(const int* ire, const int* icp, const int* lenarr, double* values) {
  get(ire, icp, "cntc_gethertzcontact", given(values, *lenarr), hertz);
}

void cntc_getnumelements(const int* ire, const int* icp, int* mx, int* my) {
  *mx = *my = -1;
  with_problem(*ire, *icp, "cntc_getnumelements", [&](Problem& p) {
    const Grid g = grid_of(p);
    *mx = g.mx;
    *my = g.my;
  });
}

void cntc_getgriddiscretization(const int* ire, const int* icp, double* dx, double* dy) {
  *dx = *dy = kNoNumber;
  with_problem(*ire, *icp, "cntc_getgriddiscretization", [&](Problem& p) {
    const Grid g = grid_of(p);
    *dx = g.dx;
    *dy = g.dy;
  });
}

void cntc_getpotcontact(const int* ire, const int* icp, const int* lenarr, double* values) {
  get(ire, icp, "cntc_getpotcontact", given(values, *lenarr), [](Problem& p) {
    const Grid g = grid_of(p);
    return std::array<double, 6>{double(g.mx), double(g.my), g.x, g.y, g.dx, g.dy};
  });
}

void cntc_getpenetration(const int* ire, const int* icp, double* pen) {
  get(ire, icp, "cntc_getpenetration", given(pen, 1), [](Problem& p) { return std::array{approach(p)}; });
}

void cntc_getcreepages(const int* ire, const int* icp, double* vx, double* vy, double* phi) {
  *vx = *vy = *phi = kNoNumber;
  with_problem(*ire, *icp, "cntc_getcreepages", [&](Problem& p) { scatter(creepages(p), vx, vy, phi); });
}

void cntc_getcontactforces(const int* ire, const int* icp, double* fn, double* tx, double* ty, double* mz) {
  *fn = *tx = *ty = *mz = kNoNumber;
  with_problem(*ire, *icp, "cntc_getcontactforces", [&](Problem& p) {
    const std::array<double, 4> all = forces(p);
    scatter(all, fn, tx, ty);
    *mz = all[3];
  });
}

void cntc_getcontactpatchareas(const int* ire, const int* icp, double* carea, double* harea, double* sarea) {
  *carea = *harea = *sarea = kNoNumber;
  with_problem(*ire, *icp, "cntc_getcontactpatchareas", [&](Problem& p) { scatter(areas(p), carea, harea, sarea); });
}

void cntc_getelementdivision(const int* ire, const int* icp, const int* lenarr, int* eldiv) {
  const auto out = given(eldiv, *lenarr);
  std::fill(out.begin(), out.end(), -1);
  with_problem(*ire, *icp, "cntc_getelementdivision", [&](Problem& p) {
    const std::vector<int> all = division(p);
    std::copy_n(all.begin(), std::min(all.size(), out.size()), out.begin());
  });
}

void cntc_getmaximumpressure(const int* ire, const int* icp, double* pnmax) {
  get(ire, icp, "cntc_getmaximumpressure", given(pnmax, 1), [](Problem& p) { return std::array{largest_pressure(p)}; });
}

void cntc_getmaximumtraction(const int* ire, const int* icp, double* ptmax) {
  get(ire, icp, "cntc_getmaximumtraction", given(ptmax, 1), [](Problem& p) { return std::array{largest_traction(p)}; });
}

void cntc_getmaximumtemperature(const int* ire, const int* icp, double* t1max, double* t2max) {
  *t1max = *t2max = kNoNumber;
  with_problem(*ire, *icp, "cntc_getmaximumtemperature", [&](Problem& p) { *t1max = *t2max = largest_temperature(p); });
}

void cntc_getfielddata(const int* ire, const int* icp, const int* ifld, const int* lenarr, double* fld) {
  get_field(ire, icp, "cntc_getfielddata", *ifld, *lenarr, fld);
}

void cntc_gettractions(const int* ire, const int* icp, const int* lenarr, double* pn, double* px, double* py) {
  get_field(ire, icp, "cntc_gettractions", kPressure, *lenarr, pn);
  get_field(ire, icp, "cntc_gettractions", kTractionX, *lenarr, px);
  get_field(ire, icp, "cntc_gettractions", kTractionY, *lenarr, py);
}

void cntc_getmicroslip(const int* ire, const int* icp, const int* lenarr, double* sx, double* sy) {
  get_field(ire, icp, "cntc_getmicroslip", kSlipX, *lenarr, sx);
  get_field(ire, icp, "cntc_getmicroslip", kSlipY, *lenarr, sy);
}

void cntc_getdisplacements(const int* ire, const int* icp, const int* lenarr, double* un, double* ux, double* uy) {
  get_field(ire, icp, "cntc_getdisplacements", kDisplacementN, *lenarr, un);
  get_field(ire, icp, "cntc_getdisplacements", kDisplacementX, *lenarr, ux);
  get_field(ire, icp, "cntc_getdisplacements", kDisplacementY, *lenarr, uy);
}

void cntc_getsensitivities(const int* ire, const int* icp, const int* lenout, const int* lenin, double* sens) {
  copy_to(given(sens, *lenout * *lenin), std::span<const double>());
  with_problem(*ire, *icp, "cntc_getsensitivities", [](Problem&) {
    throw Refused(kOther, "sensitivities are not computed: take differences of two solutions");
  });
}

void cntc_getcalculationtime(const int* ire, const int* icp, double* tcpu, double* twall) {
  *tcpu = *twall = kNoNumber;
  with_problem(*ire, *icp, "cntc_getcalculationtime", [&](Problem& p) {
    *tcpu = p.cpu_s;
    *twall = p.wall_s;
  });
}

void cntc_resetcalculationtime(const int* ire, const int* icp) {
  with_problem(*ire, *icp, "cntc_resetcalculationtime", [](Problem& p) { p.cpu_s = p.wall_s = 0; });
}

void subs_getblocksize(const int* ire, const int* icp, const int* iblk, int* nx, int* ny, int* nz) {
  *nx = *ny = *nz = -1;
  with_problem(*ire, *icp, "subs_getblocksize", [&](Problem& p) {
    const std::array<int, 3> size = block_size(p, *iblk);
    *nx = size[0];
    *ny = size[1];
    *nz = size[2];
  });
}

void subs_getresults(const int* ire, const int* icp, const int* iblk, const int* lenarr, const int* ncol,
                     const int* icol, double* values) {
  for (int c = 0; c < *ncol; ++c)
    get(ire, icp, "subs_getresults", given(values + static_cast<std::ptrdiff_t>(c) * *lenarr, *lenarr),
        [&](Problem& p) { return block_column(p, *iblk, icol[c]); });
}

void rscntc_lasterror(const int* ire, const int* icp, int* code, char* message, const int* len) {
  *code = 0;
  const auto out = given(message, *len);
  if (!out.empty()) out[0] = '\0';
  guarded(*ire, *icp, nullptr, "rscntc_lasterror", [&] {
    const Refusal last = registry().last(*ire, *icp);
    *code = last.code;
    if (out.empty()) return;
    const std::size_t n = std::min(last.text.size(), out.size() - 1);
    std::copy_n(last.text.begin(), n, out.begin());
    out[n] = '\0';
  });
}

}  // extern "C"
