/* CONTACT's interface, called as a C program calls it that loads it by its path: on Linux and on Windows alike.
 *
 * usage: contact_driver LIBRARY < set-ups
 * A set-up is a line of numbers: A B (1/mm), dx (mm), half the elements along x and y, digits T and F, FX relative,
 * creepages (-, -, rad/mm). A line of numbers comes back for each, with every digit: error, elements in contact and in
 * slip, FN FX FY MZ, approach, creepages, largest pressure and traction, stresses at three depths below the middle. */
#include <stdio.h>
#include <stdlib.h>

#include "cntc/railstrata_cntc.h"

#ifdef _WIN32
#include <windows.h>
static void* opened(const char* file) { return (void*)LoadLibraryA(file); }
static void* found(void* library, const char* name) { return (void*)GetProcAddress((HMODULE)library, name); }
static void closed(void* library) { FreeLibrary((HMODULE)library); }
#else
#include <dlfcn.h>
static void* opened(const char* file) { return dlopen(file, RTLD_NOW); }
static void* found(void* library, const char* name) { return dlsym(library, name); }
static void closed(void* library) { dlclose(library); }
#endif

static void* library;
static void* function(const char* name) {
  void* const f = found(library, name);
  if (!f) {
    printf("%s is not there\n", name);
    exit(1);
  }
  return f;
}
#define CALL(name) ((__typeof__(&name))function(#name))

enum { MOST = 40000 };
static const int ire = 1, icp = 1;
static const int none = 0, one = 1, two = 2, three = 3, four = 4, six = 6;

static void set_up(double a, double b, double dx, const int* half, const int* digits, double fx, const double* creep) {
  static const int flags[] = {1933, 1970, 1972, 1974}; /* units, P, T, F */
  const double shear = 210000 / 2.6, load = 84954.6, fy = 0;
  const double material[] = {0.3, 0.3, shear, shear}, friction[] = {0.5, 0.5}, gap[] = {a, 0, b, 0, 0, 0};
  const double grid[] = {2 * half[0] + 1, 2 * half[1] + 1, -half[0] * dx, -half[1] * dx, dx, dx};
  const int values[] = {1934, 2, digits[0], digits[1]};
  CALL(cntc_setflags)(&ire, &icp, &four, flags, values);
  CALL(cntc_setmaterialparameters)(&ire, &icp, &none, &four, material);
  CALL(cntc_setfrictionmethod)(&ire, &icp, &none, &two, friction);
  CALL(cntc_setpotcontact)(&ire, &icp, &three, &six, grid);
  CALL(cntc_setundeformeddistc)(&ire, &icp, &one, &six, gap);
  CALL(cntc_setnormalforce)(&ire, &icp, &load);
  CALL(cntc_settangentialforces)(&ire, &icp, &fx, &fy);
  CALL(cntc_setcreepages)(&ire, &icp, &creep[0], &creep[1], &creep[2]);
}

static void print_elements(void) {
  static int division[MOST];
  int mx, my, i, contact = 0, slip = 0, count;
  CALL(cntc_getnumelements)(&ire, &icp, &mx, &my);
  count = mx * my;
  CALL(cntc_getelementdivision)(&ire, &icp, &count, division);
  for (i = 0; i < count; ++i) {
    contact += division[i] > 0;
    slip += division[i] == 2;
  }
  printf(" %d %d", contact, slip);
}

static void print_stresses(void) {
  static const int block = 1, kind = 9, columns[] = {7, 12, 16, 20}, lines = 3;
  const double x = 0, depth[] = {-4, -2, -1};
  double out[12];
  int error, i;
  CALL(subs_addblock)(&ire, &icp, &block, &kind, &one, &one, &lines, &x, &x, depth);
  CALL(subs_calculate)(&ire, &icp, &error);
  CALL(subs_getresults)(&ire, &icp, &block, &lines, &four, columns, out);
  printf(" %d", error);
  for (i = 0; i < 12; ++i) printf(" %.17g", out[i]);
}

static void print_results(int error) {
  double v[10];
  int i;
  printf("%d", error);
  print_elements();
  CALL(cntc_getcontactforces)(&ire, &icp, &v[0], &v[1], &v[2], &v[3]);
  CALL(cntc_getpenetration)(&ire, &icp, &v[4]);
  CALL(cntc_getcreepages)(&ire, &icp, &v[5], &v[6], &v[7]);
  CALL(cntc_getmaximumpressure)(&ire, &icp, &v[8]);
  CALL(cntc_getmaximumtraction)(&ire, &icp, &v[9]);
  for (i = 0; i < 10; ++i) printf(" %.17g", v[i]);
  print_stresses();
  printf("\n");
  fflush(stdout);
}

int main(int argc, char** argv) {
  const int quiet = -1;
  int version, error, half[2], digits[2];
  double a, b, dx, fx, creep[3];
  if (argc != 2 || !(library = opened(argv[1]))) {
    printf("cannot load %s\n", argc == 2 ? argv[1] : "nothing");
    return 1;
  }
  CALL(cntc_initializefirst)(&version, &error, &quiet, " ", " ", " ", &one, &one, &one);
  if (error != 0 || version != 2510) return 1;
  while (scanf("%lf %lf %lf %d %d %d %d %lf %lf %lf %lf", &a, &b, &dx, &half[0], &half[1], &digits[0], &digits[1], &fx,
               &creep[0], &creep[1], &creep[2]) == 11) {
    set_up(a, b, dx, half, digits, fx, creep);
    CALL(cntc_calculate)(&ire, &icp, &error);
    print_results(error);
  }
  CALL(cntc_finalizelast)();
  closed(library);
  return 0;
}
