/* For bogie.c: processor times in a list, linear equations, an irregularity. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct times {
  double* ms;
  size_t count, room;
} times;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void add(times* list, double ms) {
  if (list->count == list->room) {
    list->room = 2 * list->room + 1000;
    list->ms = realloc(list->ms, list->room * sizeof(double));
    if (!list->ms) exit(RS_MACHINE);
  }
  list->ms[list->count++] = ms;
}

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

/* Returns the sum, ms. */
static double print_times(const char* name, times* list) {
  const size_t n = list->count;
  double sum = 0;
  size_t i;
  if (n == 0) return 0;
  qsort(list->ms, n, sizeof(double), compare);
  for (i = 0; i < n; ++i) sum += list->ms[i];
  fprintf(stderr, "%-22s %6lu: median %6.2f, p99 %6.2f, most %7.2f ms; sum %6.1f s\n", name, (unsigned long)n,
          list->ms[n / 2], list->ms[(size_t)(0.99 * (double)n)], list->ms[n - 1], 1e-3 * sum);
  return sum;
}

/* b becomes the solution of a x = b; a, n rows of n, is used up. */
static void solve(int n, double* a, double* b) {
  int i, j, k;
  for (k = 0; k < n; ++k)
    for (i = 0; i < n; ++i) {
      const double share = a[n * i + k] / a[n * k + k];
      if (i == k || share == 0) continue;
      for (j = k; j < n; ++j) a[n * i + j] -= share * a[n * k + j];
      b[i] -= share * b[k];
    }
  for (k = 0; k < n; ++k) b[k] /= a[n * k + k];
}

/* m, of both rails aside: waves of 4 to 40 m. */
static double irregularity(double x) {
  double sum = 0;
  int k;
  for (k = 0; k < 24; ++k) {
    const double wave = 4 * pow(10, k / 23.0);
    sum += 0.06e-3 * pow(wave / 10, 0.75) * sin(6.28318530717959 * x / wave + 2.4 * k * k);
  }
  return x < 10 ? sum * x / 10 : sum;
}
