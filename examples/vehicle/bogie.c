/* A bogie from straight track into a curve of 500 m to the right, by an implicit integrator whose Newton steps take
 * their derivatives from rs_wheelset_jacobian; at its end the processor times of all solutions. docs/vehicle.md.
 * usage: bogie CASE load|height STEP SECONDS (s, s)
 * load: heights and rolls of the wheelsets follow from their loads. height: they are motions of their own.
 * Masses and primary springs are those of Manchester's first vehicle [Iwnicki1998]. */
#define _POSIX_C_SOURCE 199309L
#include <string.h>

#include <railstrata/railstrata.h>

#include "bogie_tools.h"

/* Motions, m and rad, from the axis of the track below: of each wheelset these nine, the last beyond speed / radius; of
 * the frame y, yaw and their rates. */
enum { Y, YAW, Z, ROLL, Y_RATE, YAW_RATE, Z_RATE, ROLL_RATE, PITCH_RATE, AXLE, FRAME = 2 * AXLE, ALL = FRAME + 4 };
static const int inputs[AXLE] = {RS_BY_Y,        RS_BY_YAW,    RS_BY_Z,         RS_BY_ROLL,      RS_BY_Y_RATE,
                                 RS_BY_YAW_RATE, RS_BY_Z_RATE, RS_BY_ROLL_RATE, RS_BY_PITCH_RATE};

static const double curve = 500, straight = 20, ramp = 60, cant = 0.1, base = 1.5; /* m */
static const double speed = 20, radius = 0.46;
static const double mass = 1813, inertia = 1120, pitch_inertia = 112, frame_mass = 2615, frame_inertia = 3067;
static const double load = 109.1e3, gravity = 9.81, height = 1.3; /* N, of an axle; m, centre of gravity over axles */
static const double place[2] = {1.28, -1.28};                     /* m, of the axles before the middle of the frame */
static const double sideways = 7.77e6, turning = 62.8e6;          /* N/m, N m/rad: both boxes, 2 m apart */
static const double damping = 8e3, frame_damping = 64e3, frame_turning = 1e6; /* N s/m, N s/m, N m s/rad */
static const double close_to[3] = {1e-8, 1e-5, 1e-4}; /* Newton's: m and rad, m/s and rad/s, rad/s of the pitch */

static int by_height, newton_steps, failed, after_others, beyond;
static int pairs;   /* of contacts, solved */
static int lost[2]; /* wheelsets without an answer */
static rs_wheelset* axles[2];
static rs_wheelset_forces forces[2];
static times with_one, with_two, of_derivatives;

/* Share of the curvature and of the cant. */
static double into(double x) { return x < straight ? 0 : x > straight + ramp ? 1 : (x - straight) / ramp; }

/* m/s2 outwards, to the left. */
static double push(double x) { return into(x) * (speed * speed / curve - gravity * cant / base); }

static double roll_moment(double x) { return -load / gravity * push(x) * height; }

static rs_wheelset_state state_of(double x, const double* w) {
  rs_wheelset_state s;
  memset(&s, 0, sizeof(s));
  s.size = sizeof(s);
  s.given = by_height ? RS_WHEELSET_Z | RS_WHEELSET_ROLL : RS_WHEELSET_LOAD;
  s.load = by_height ? 0 : load;
  s.roll_moment = by_height ? 0 : roll_moment(x);
  s.speed = speed;
  s.y = w[Y];
  s.yaw = w[YAW];
  s.z = w[Z];
  s.roll = w[ROLL];
  s.y_rate = w[Y_RATE];
  s.yaw_rate = w[YAW_RATE] - into(x) * speed / curve; /* the track itself turns to the right */
  s.z_rate = w[Z_RATE];
  s.roll_rate = w[ROLL_RATE];
  s.pitch_rate = w[PITCH_RATE];
  s.rail_y[RS_LEFT] = s.rail_y[RS_RIGHT] = irregularity(x);
  return s;
}

static void stop(const char* what, const rs_error* error) {
  fprintf(stderr, "%s: error %d: %s\n", what, error->code, error->message);
  exit(error->code);
}

/* Writes a state without an answer, by its numbers from y to wheel_pitch_rate, and asks once more, from nothing.
 * Without an answer still, the forces of the last one stay. */
static void ask_again(int i, double x, const rs_wheelset_state* s, rs_error* error) {
  const double* number;
  fprintf(stderr, "x = %.4f m, axle %d: error %d: %s\n  given = %u:", x, i, error->code, error->message, s->given);
  for (number = &s->y; number < s->rail_yaw; ++number) fprintf(stderr, " %.17g", *number);
  rs_wheelset_forget(axles[i]);
  lost[i] = rs_wheelset_solve(axles[i], s, &forces[i], error) != RS_OK;
  fprintf(stderr, "\n  from nothing: %s\n", lost[i] ? error->message : "an answer");
  ++*(lost[i] ? &failed : &after_others);
}

static void contact(int i, double x, const double* w) {
  const rs_wheelset_state s = state_of(x, w);
  const rs_wheel* wheel = forces[i].wheel;
  const double begin = now();
  rs_error error;
  forces[i].size = sizeof(forces[i]);
  if (rs_wheelset_solve(axles[i], &s, &forces[i], &error)) {
    ask_again(i, x, &s, &error);
    return;
  }
  lost[i] = 0;
  add(wheel[0].patches > 1 || wheel[1].patches > 1 ? &with_two : &with_one, now() - begin);
  beyond += forces[i].beyond;
  pairs += forces[i].solutions;
}

/* Rates of all motions at the place x of the frame, with the contact forces that were found last. */
static void rates(double x, const double* q, double* out) {
  const double bend = -into(x) / curve, *frame = q + FRAME;
  double force = (2 * load / gravity - 2 * mass) * push(x) - frame_damping * frame[2];
  double moment = -frame_turning * frame[3];
  int i, k;
  for (i = 0; i < 2; ++i) {
    const double at = place[i], *w = q + AXLE * i, *f = forces[i].force, *m = forces[i].moment;
    const double spring = sideways * (w[Y] + bend * at * at / 2 - frame[0] - at * frame[1]);
    const double turn = turning * (w[YAW] + bend * at - frame[1]);
    double* rate = out + AXLE * i;
    for (k = 0; k < 4; ++k) rate[k] = w[k + 4];
    rate[Y_RATE] = (f[1] - spring) / mass + push(x + at);
    rate[YAW_RATE] = (m[2] - turn) / inertia;
    rate[Z_RATE] = by_height * (f[2] - load - damping * w[Z_RATE]) / mass;
    rate[ROLL_RATE] = by_height * (m[0] + roll_moment(x + at) - damping * w[ROLL_RATE]) / inertia;
    rate[PITCH_RATE] = m[1] / pitch_inertia;
    force += spring;
    moment += turn + at * spring;
  }
  out[FRAME] = frame[2];
  out[FRAME + 1] = frame[3];
  out[FRAME + 2] = force / frame_mass;
  out[FRAME + 3] = moment / frame_inertia;
}

/* Adds what the contact forces of a wheelset do; z and roll that are found follow the others. */
static void add_contact_slopes(int i, double jacobian[ALL][ALL]) {
  rs_wheelset_derivatives by[AXLE];
  int wanted[AXLE], of[AXLE], n = 0, k;
  const double begin = now();
  rs_error error;
  for (k = 0; k < AXLE; ++k) {
    if (!by_height && (k == Z || k == ROLL)) continue;
    by[n].size = sizeof(by[n]);
    of[n] = k;
    wanted[n++] = inputs[k];
  }
  if (rs_wheelset_jacobian(axles[i], wanted, n, by, &error)) stop("derivatives", &error);
  for (k = 0; k < n; ++k) {
    const int first = AXLE * i, column = first + of[k];
    jacobian[first + Y_RATE][column] += by[k].force[1] / mass;
    jacobian[first + YAW_RATE][column] += by[k].moment[2] / inertia;
    jacobian[first + Z_RATE][column] += by_height * by[k].force[2] / mass;
    jacobian[first + ROLL_RATE][column] += by_height * by[k].moment[0] / inertia;
    jacobian[first + PITCH_RATE][column] += by[k].moment[1] / pitch_inertia;
  }
  add(&of_derivatives, now() - begin);
}

/* Of the rates by all motions; springs and dampers are linear. */
static void differentiate(double x, double jacobian[ALL][ALL]) {
  double q[ALL] = {0}, still[ALL], moved[ALL];
  int i, j;
  rates(x, q, still);
  for (j = 0; j < ALL; ++j) {
    q[j] = 1;
    rates(x, q, moved);
    q[j] = 0;
    for (i = 0; i < ALL; ++i) jacobian[i][j] = moved[i] - still[i];
  }
  for (i = 0; i < 2; ++i) add_contact_slopes(i, jacobian);
}

/* Solves q = known + factor rates(q) from q on; whether Newton's steps ended. */
static int newton(double x, const double* known, double factor, double jacobian[ALL][ALL], double* q) {
  int step, i, j;
  for (step = 0; step < 8; ++step) {
    double a[ALL][ALL], b[ALL], far = 0;
    for (i = 0; i < 2; ++i) contact(i, x + place[i], q + AXLE * i);
    rates(x, q, b);
    for (i = 0; i < ALL; ++i) {
      b[i] = known[i] + factor * b[i] - q[i];
      for (j = 0; j < ALL; ++j) a[i][j] = (i == j) - factor * jacobian[i][j];
    }
    solve(ALL, a[0], b);
    ++newton_steps;
    for (i = 0; i < ALL; ++i) {
      const double unit = close_to[i < FRAME ? i % AXLE / 4 : (i - FRAME) / 2];
      if (fabs(b[i]) > far * unit) far = fabs(b[i]) / unit;
      q[i] += b[i];
    }
    if (far <= 1) return 1;
  }
  return 0;
}

/* Both wheelsets roll freely in the middle of the track. */
static void begin(const char* case_file, int height_given, double* q) {
  rs_error error;
  int i, side;
  for (i = 0; i < 2; ++i) {
    double* w = q + AXLE * i;
    axles[i] = rs_wheelset_new(case_file, NULL, 0, NULL, 0, &error);
    if (!axles[i]) stop(case_file, &error);
    for (side = RS_LEFT; side <= RS_RIGHT; ++side) rs_set_cell(rs_wheelset_contact(axles[i], side), 1e-3, NULL);
    contact(i, 0, w);
    w[Z] = height_given ? forces[i].z : 0;
    w[PITCH_RATE] = speed / forces[i].wheel[RS_LEFT].rolling_radius - speed / radius;
  }
  by_height = height_given;
  for (i = 0; i < 2; ++i) contact(i, 0, q + AXLE * i);
}

static void print_row(double t, const double* q) {
  int i;
  printf("%.3f", t);
  for (i = 0; i < 2; ++i) {
    const rs_wheel* wheel = forces[i].wheel;
    printf(",%.5f,%.5f,%.3f,%.3f,%d", 1e3 * q[AXLE * i + Y], 1e3 * q[AXLE * i + YAW], 1e-3 * wheel[0].force[2],
           1e-3 * wheel[0].force[1], wheel[0].patches + wheel[1].patches);
  }
  printf("\n");
}

int main(int argc, char** argv) {
  double q[ALL] = {0}, last[ALL], known[ALL], jacobian[ALL][ALL], step, ms;
  int k, steps, i, due = 1, unfinished = 0;
  if (argc != 5) return 2;
  step = atof(argv[3]);
  steps = (int)(atof(argv[4]) / step + 0.5);
  begin(argv[1], strcmp(argv[2], "height") == 0, q);
  memcpy(last, q, sizeof(q));
  printf("t_s,y1_mm,yaw1_mrad,Q1_kN,Y1_kN,patches1,y2_mm,yaw2_mrad,Q2_kN,Y2_kN,patches2\n");
  /* Backward differences of second order: for stiff creep and, with heights, stiff contacts. */
  for (k = 1; k <= steps; ++k) {
    const double x = speed * step * k;
    for (i = 0; i < ALL; ++i) {
      const double next = 2 * q[i] - last[i];
      known[i] = (4 * q[i] - last[i]) / 3;
      last[i] = q[i];
      q[i] = next;
    }
    if (k >= due && !lost[0] && !lost[1]) {
      differentiate(x, jacobian);
      due = k + 20;
    }
    unfinished += !newton(x, known, step * 2 / 3, jacobian, q);
    if (k % 50 == 0) print_row(step * k, q);
  }
  ms = print_times("states, one patch", &with_one) + print_times("states, two patches", &with_two) +
       print_times("derivatives", &of_derivatives);
  fprintf(stderr, "%d steps, %d of Newton, %d without end, %d pairs of contacts, ", steps, newton_steps, unfinished,
          pairs);
  fprintf(stderr, "%d failed, %d after others alone, %d beyond, %.1f s\n", failed, after_others, beyond, 1e-3 * ms);
  return 0;
}
