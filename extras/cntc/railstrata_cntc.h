/* RailStrata behind the library interface of CONTACT (eve70a/CONTACT, contact_addon.h): the basic contact module
 * (module 3) by RailStrata's half-space engine, and one call more for layers. C89. docs/contact-interface.md describes
 * what is offered, what is refused, and how CONTACT's MATLAB and Python wrappers find it.
 *
 * `ire` is a result element, 1 to 999, `icp` a contact problem on it, 1 to 9. Units and signs: flag 1933. Every
 * argument is a pointer. Arrays of elements run with x fastest: element (ix, iy) is at ix + mx iy, both from 0.
 *
 * What is not offered is not done: the next cntc_calculate of that problem answers with a negative code of CONTACT's
 * list, outputs are NaN (integers -1), and rscntc_lasterror and the file <experiment>.out have the reason.
 *
 * Threads: initialisation, global flags and finalisation outside of parallel regions; several problems at once, each by
 * one thread at a time. */
#ifndef RAILSTRATA_CNTC_H
#define RAILSTRATA_CNTC_H

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define RSCNTC_API __attribute__((visibility("default")))
#else
#define RSCNTC_API
#endif

/* -------------------------------------------------------------------------------------------------- begin and end */
/* ifcver: 2510, the version of CONTACT's interface. ioutput: 0 messages go to <outdir>/<expnam>.out, 1 to the screen
 * too, others (not of CONTACT) nowhere. The file is opened with the first message. */
RSCNTC_API void cntc_initializefirst(int* ifcver, int* ierror, const int* ioutput, const char* wrkdir,
                                     const char* outdir, const char* expnam, const int* len_wrkdir,
                                     const int* len_outdir, const int* len_expnam);
RSCNTC_API void cntc_initializefirst_new(int* ifcver, int* ierror, const int* ioutput, const char* wrkdir,
                                         const char* outdir, const char* expnam, const int* len_wrkdir,
                                         const int* len_outdir, const int* len_expnam);
/* imodul: 1 (wheel on rail) or 3 (basic contact). In module 1 the patches are icp 1, 2, ... and icp = -1 is all. */
RSCNTC_API void cntc_initialize(const int* ire, const int* imodul, int* ifcver, int* ierror, const char* outdir,
                                const int* len_outdir);
RSCNTC_API void cntc_finalize(const int* ire);
RSCNTC_API void cntc_finalizelast(void);
RSCNTC_API void cntc_setglobalflags(const int* lenflg, const int* params, const int* values);
RSCNTC_API void cntc_readinpfile(const int* ire, const int* inp_type, const char* fname, const int* len_fname,
                                 int* ierror);

/* -------------------------------------------------------------------------------------------------------- settings */
RSCNTC_API void cntc_setflags(const int* ire, const int* icp, const int* lenflg, const int* params, const int* values);
RSCNTC_API void cntc_setmetadata(const int* ire, const int* icp, const int* lenmta, const int* params,
                                 const double* values);
RSCNTC_API void cntc_setsolverflags(const int* ire, const int* icp, const int* gdigit, const int* nints,
                                    const int* iparam, const int* nreals, const double* rparam);
/* mdigit 0: nu1, nu2, g1, g2; and after these 1 viscoelastic: fg1, fg2, tc1, tc2; 3 FASTSIM, 5 FaStrip: k0_mf, alfamf,
   betamf; 4 with a film: g3, laythk, tau_c0, k_tau */
RSCNTC_API void cntc_setmaterialparameters(const int* ire, const int* icp, const int* mdigit, const int* nparam,
                                           const double* rparam);
RSCNTC_API void cntc_settemperaturedata(const int* ire, const int* icp, const int* imeth, const int* nparam,
                                        const double* rparam);
/* The units are taken and not used: no files are opened by number. */
RSCNTC_API void cntc_setfileunits(const int* nunits, const int* iunits);
/* As many as the machine offers: no licence counts them. */
RSCNTC_API void cntc_getmaxnumthreads(int* mxthrd);
RSCNTC_API void cntc_settimestep(const int* ire, const int* icp, const double* dt);
RSCNTC_API void cntc_setreferencevelocity(const int* ire, const int* icp, const double* veloc);
RSCNTC_API void cntc_setrollingstepsize(const int* ire, const int* icp, const double* chi, const double* dq);
/* imeth 0: fstat, fkin; 3 and 4: fkin, f1, sabsh1, 0, sabsh2, 0, mem_s0 */
RSCNTC_API void cntc_setfrictionmethod(const int* ire, const int* icp, const int* imeth, const int* nparam,
                                       const double* params);
RSCNTC_API void cntc_sethertzcontact(const int* ire, const int* icp, const int* ipotcn, const int* nparam,
                                     const double* rparam);
RSCNTC_API void cntc_setpotcontact(const int* ire, const int* icp, const int* ipotcn, const int* nparam,
                                   const double* rparam);
RSCNTC_API void cntc_setverticalforce(const int* ire, const double* fz);
RSCNTC_API void cntc_setpenetration(const int* ire, const int* icp, const double* pen);
RSCNTC_API void cntc_setnormalforce(const int* ire, const int* icp, const double* fn);
RSCNTC_API void cntc_setundeformeddistc(const int* ire, const int* icp, const int* ibase, const int* nparam,
                                        const double* prmudf);
RSCNTC_API void cntc_setcreepages(const int* ire, const int* icp, const double* vx, const double* vy,
                                  const double* phi);
RSCNTC_API void cntc_setextrarigidslip(const int* ire, const int* icp, const int* lenarr, const double* wx,
                                       const double* wy);
/* Relative to fstat fn, on body 1. */
RSCNTC_API void cntc_settangentialforces(const int* ire, const int* icp, const double* fx, const double* fy);
RSCNTC_API void cntc_setprofileinputfname(const int* ire, const char* fname, const int* len_fname, const int* nints,
                                          const int* iparam, const int* nreals, const double* rparam);
RSCNTC_API void cntc_setprofileinputvalues(const int* ire, const int* npoint, const double* values, const int* nints,
                                           const int* iparam, const int* nreals, const double* rparam);
RSCNTC_API void cntc_settrackdimensions(const int* ire, const int* ztrack, const int* nparam, const double* rparam);
RSCNTC_API void cntc_setwheelsetdimensions(const int* ire, const int* ewheel, const int* nparam, const double* rparam);
RSCNTC_API void cntc_setwheelsetposition(const int* ire, const int* ewheel, const int* nparam, const double* rparam);
RSCNTC_API void cntc_setwheelsetvelocity(const int* ire, const int* ewheel, const int* nparam, const double* rparam);
RSCNTC_API void cntc_setwheelsetflexibility(const int* ire, const int* ewheel, const int* nparam, const double* rparam);
RSCNTC_API void subs_addblock(const int* ire, const int* icp, const int* iblk, const int* isubs, const int* nx,
                              const int* ny, const int* nz, const double* xparam, const double* yparam,
                              const double* zparam);

/* -------------------------------------------------------------------------------------------------------- solutions */
/* ierror: 0; above 0: so many elements in contact at the border of the potential contact area, which is too small;
 * below 0: CONTACT's codes. */
RSCNTC_API void cntc_calculate(const int* ire, const int* icp, int* ierror);
RSCNTC_API void subs_calculate(const int* ire, const int* icp, int* ierror);

/* ---------------------------------------------------------------------------------------------------------- results */
RSCNTC_API void cntc_getflags(const int* ire, const int* icp, const int* nparam, const int* iparam, int* values);
RSCNTC_API void cntc_getparameters(const int* ire, const int* icp, const int* itask, const int* lenarr, double* values);
RSCNTC_API void cntc_getprofilevalues(const int* ire, const int* itask, const int* nints, const int* iparam,
                                      const int* nreals, const double* rparam, const int* lenarr, double* values);
RSCNTC_API void cntc_getprofilevalues_new(const int* ire, const int* itask, const int* nints, const int* iparam,
                                          const int* nreals, const double* rparam, const int* lenarr, double* values);
RSCNTC_API void cntc_getwheelsetposition(const int* ire, const int* lenarr, double* values);
RSCNTC_API void cntc_getwheelsetvelocity(const int* ire, const int* lenarr, double* values);
RSCNTC_API void cntc_getnumcontactpatches(const int* ire, int* npatch);
RSCNTC_API void cntc_getcontactlocation(const int* ire, const int* icp, const int* lenarr, double* values);
RSCNTC_API void cntc_getreferencevelocity(const int* ire, const int* icp, double* veloc);
RSCNTC_API void cntc_gethertzcontact(const int* ire, const int* icp, const int* lenarr, double* values);
RSCNTC_API void cntc_getnumelements(const int* ire, const int* icp, int* mx, int* my);
RSCNTC_API void cntc_getgriddiscretization(const int* ire, const int* icp, double* dx, double* dy);
RSCNTC_API void cntc_getpotcontact(const int* ire, const int* icp, const int* lenarr, double* values);
RSCNTC_API void cntc_getpenetration(const int* ire, const int* icp, double* pen);
RSCNTC_API void cntc_getcreepages(const int* ire, const int* icp, double* vx, double* vy, double* phi);
RSCNTC_API void cntc_getcontactforces(const int* ire, const int* icp, double* fn, double* tx, double* ty, double* mz);
RSCNTC_API void cntc_getglobalforces(const int* ire, const int* icp, const int* lenarr, double* values);
RSCNTC_API void cntc_getcontactpatchareas(const int* ire, const int* icp, double* carea, double* harea, double* sarea);
RSCNTC_API void cntc_getelementdivision(const int* ire, const int* icp, const int* lenarr, int* eldiv);
RSCNTC_API void cntc_getmaximumpressure(const int* ire, const int* icp, double* pnmax);
RSCNTC_API void cntc_getmaximumtraction(const int* ire, const int* icp, double* ptmax);
RSCNTC_API void cntc_getmaximumtemperature(const int* ire, const int* icp, double* t1max, double* t2max);
RSCNTC_API void cntc_getfielddata(const int* ire, const int* icp, const int* ifld, const int* lenarr, double* fld);
RSCNTC_API void cntc_gettractions(const int* ire, const int* icp, const int* lenarr, double* pn, double* px,
                                  double* py);
RSCNTC_API void cntc_getmicroslip(const int* ire, const int* icp, const int* lenarr, double* sx, double* sy);
RSCNTC_API void cntc_getdisplacements(const int* ire, const int* icp, const int* lenarr, double* un, double* ux,
                                      double* uy);
RSCNTC_API void cntc_getsensitivities(const int* ire, const int* icp, const int* lenout, const int* lenin,
                                      double* sens);
RSCNTC_API void cntc_getcalculationtime(const int* ire, const int* icp, double* tcpu, double* twall);
RSCNTC_API void cntc_resetcalculationtime(const int* ire, const int* icp);
RSCNTC_API void subs_getblocksize(const int* ire, const int* icp, const int* iblk, int* nx, int* ny, int* nz);
RSCNTC_API void subs_getresults(const int* ire, const int* icp, const int* iblk, const int* lenarr, const int* ncol,
                                const int* icol, double* values);

/* ------------------------------------------------------------------------------------- what CONTACT does not have */
/* Bonded elastic layers on body 1 or 2, from the surface down; what cntc_setmaterialparameters gives is then the
 * material under them. thickness [length], young [force/area], n = 0: none. */
RSCNTC_API void rscntc_setlayers(const int* ire, const int* icp, const int* body, const int* n, const double* thickness,
                                 const double* young, const double* poisson);
/* The last refusal or remark of a problem, or of the library where icp is no problem: its code (0: a remark or
 * nothing) and its text, cut to len - 1 characters and closed by a zero. */
RSCNTC_API void rscntc_lasterror(const int* ire, const int* icp, int* code, char* text, const int* len);

#ifdef __cplusplus
}
#endif
#endif
