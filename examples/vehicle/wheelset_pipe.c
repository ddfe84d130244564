/* A wheelset for programs that cannot load a library: a state a line on the input (y yaw y_rate yaw_rate speed load
 * rail_y, of both rails; SI), a line of the lateral force, the moment about z and the rolling radii on the output.
 * The wheels roll freely in the middle of the track.
 * usage: wheelset_pipe CASE */
#include <stdio.h>
#include <string.h>

#include <railstrata/railstrata.h>

int main(int argc, char** argv) {
  rs_error error;
  rs_wheelset_state s;
  rs_wheelset_forces f;
  rs_wheelset* wheelset = argc == 2 ? rs_wheelset_new(argv[1], NULL, 0, NULL, 0, &error) : NULL;
  double freely;
  int side;
  if (!wheelset) {
    fprintf(stderr, "%s\n", argc == 2 ? error.message : "usage: wheelset_pipe CASE");
    return 2;
  }
  for (side = RS_LEFT; side <= RS_RIGHT; ++side) rs_set_cell(rs_wheelset_contact(wheelset, side), 1e-3, NULL);
  memset(&s, 0, sizeof(s));
  s.size = sizeof(s);
  s.given = RS_WHEELSET_LOAD;
  f.size = sizeof(f);
  s.speed = 1;
  s.load = 160e3;
  if (rs_wheelset_solve(wheelset, &s, &f, &error)) {
    fprintf(stderr, "%s\n", error.message);
    return error.code;
  }
  freely = 1 / f.wheel[RS_LEFT].rolling_radius - 1 / 0.46; /* r0 of the case */
  while (scanf("%lf %lf %lf %lf %lf %lf %lf", &s.y, &s.yaw, &s.y_rate, &s.yaw_rate, &s.speed, &s.load, s.rail_y) == 7) {
    s.rail_y[RS_RIGHT] = s.rail_y[RS_LEFT];
    s.pitch_rate = freely * s.speed;
    if (rs_wheelset_solve(wheelset, &s, &f, &error)) {
      fprintf(stderr, "%s\n", error.message);
      return error.code;
    }
    printf("%.17g %.17g %.17g %.17g\n", f.force[1], f.moment[2], f.wheel[0].rolling_radius, f.wheel[1].rolling_radius);
    fflush(stdout);
  }
  rs_wheelset_free(wheelset);
  return 0;
}
