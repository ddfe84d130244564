/* A wheelset that springs hold to a frame of constant speed, on a track that an irregularity moves aside by
 * 0.5 mm: y and yaw over the way. docs/vehicle.md.
 * usage: hunting CASE SPEED SPRINGS STEP LENGTH (m/s, a factor of the springs, m, m) */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <railstrata/railstrata.h>

static const double mass = 1500, inertia = 1000, stiffness_y = 2e6, stiffness_yaw = 2e6, load = 160e3, radius = 0.46;
static const double pi = 3.14159265358979324;
static double speed, springs, pitch_rate; /* of wheels that roll freely in the middle of the track */
static rs_wheelset* wheelset;
static rs_wheelset_forces forces;

static double irregularity(double x) { return 0.25e-3 * (1 - cos(pi * (x < 2 ? x : 2) / 2)); }

/* Rates of q = (y, yaw, their rates) at the place x. */
static void rates(double x, const double q[4], double out[4]) {
  rs_error error;
  rs_wheelset_state s;
  memset(&s, 0, sizeof(s));
  s.size = sizeof(s);
  s.given = RS_WHEELSET_LOAD;
  s.load = load;
  s.speed = speed;
  s.pitch_rate = pitch_rate;
  s.y = q[0];
  s.yaw = q[1];
  s.y_rate = q[2];
  s.yaw_rate = q[3];
  s.rail_y[RS_LEFT] = s.rail_y[RS_RIGHT] = irregularity(x);
  if (rs_wheelset_solve(wheelset, &s, &forces, &error)) {
    fprintf(stderr, "%s\n", error.message);
    exit(error.code);
  }
  out[0] = q[2];
  out[1] = q[3];
  out[2] = (forces.force[1] - springs * stiffness_y * q[0]) / mass;
  out[3] = (forces.moment[2] - springs * stiffness_yaw * q[1]) / inertia;
}

static void differentiate(double jacobian[4][4]) {
  static const double step[4] = {1e-4, 1e-4, 1e-3, 1e-3};
  double q[4] = {0, 0, 0, 0}, more[4], less[4];
  int i, j;
  for (j = 0; j < 4; ++j) {
    q[j] = step[j];
    rates(0, q, more);
    q[j] = -step[j];
    rates(0, q, less);
    q[j] = 0;
    for (i = 0; i < 4; ++i) jacobian[i][j] = (more[i] - less[i]) / (2 * step[j]);
  }
}

/* b becomes the solution of (1 - factor jacobian) x = b. */
static void solve(double jacobian[4][4], double factor, double b[4]) {
  double a[4][4];
  int i, j, k;
  for (i = 0; i < 4; ++i)
    for (j = 0; j < 4; ++j) a[i][j] = (i == j) - factor * jacobian[i][j];
  for (k = 0; k < 4; ++k)
    for (i = 0; i < 4; ++i) {
      const double share = a[i][k] / a[k][k];
      if (i == k) continue;
      for (j = 0; j < 4; ++j) a[i][j] -= share * a[k][j];
      b[i] -= share * b[k];
    }
  for (k = 0; k < 4; ++k) b[k] /= a[k][k];
}

int main(int argc, char** argv) {
  const double gamma = 1 - sqrt(0.5);
  double q[4] = {0, 0, 0, 0}, next[4], one[4], two[4], jacobian[4][4];
  double x, step, length;
  rs_error error;
  int i, side;
  if (argc != 6) return 2;
  speed = atof(argv[2]);
  springs = atof(argv[3]);
  step = atof(argv[4]);
  length = atof(argv[5]);
  wheelset = rs_wheelset_new(argv[1], NULL, 0, NULL, 0, &error);
  if (!wheelset) {
    fprintf(stderr, "%s\n", error.message);
    return error.code;
  }
  for (side = RS_LEFT; side <= RS_RIGHT; ++side) rs_set_cell(rs_wheelset_contact(wheelset, side), 1e-3, NULL);
  forces.size = sizeof(forces);
  rates(0, q, one);
  pitch_rate = speed / forces.wheel[RS_LEFT].rolling_radius - speed / radius;
  differentiate(jacobian);
  printf("x_m,y_mm,yaw_mrad,radius_difference_mm\n");
  /* ROS2: two stages with one matrix, of second order whatever the matrix is, and stable for stiff creep. */
  for (x = 0; x < length; x += step) {
    const double h = step / speed;
    rates(x, q, one);
    printf("%.4f,%.7f,%.7f,%.7f\n", x, 1e3 * q[0], 1e3 * q[1],
           1e3 * (forces.wheel[RS_LEFT].rolling_radius - forces.wheel[RS_RIGHT].rolling_radius));
    solve(jacobian, gamma * h, one);
    for (i = 0; i < 4; ++i) next[i] = q[i] + h * one[i];
    rates(x + step, next, two);
    for (i = 0; i < 4; ++i) two[i] -= 2 * one[i];
    solve(jacobian, gamma * h, two);
    for (i = 0; i < 4; ++i) q[i] += h * (1.5 * one[i] + 0.5 * two[i]);
  }
  rs_wheelset_free(wheelset);
  return 0;
}
