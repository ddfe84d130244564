/* A vehicle code of another project, in C89: forces of one wheel over its lateral position, and the stress below it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <railstrata/railstrata.h>

int main(int argc, char** argv) {
  rs_error error;
  rs_state state;
  rs_forces forces;
  rs_contact* contact;
  double below[3] = {0, 0, 2e-3}, stress[6];
  if (argc != 2) {
    printf("usage: mine CASE.toml\n");
    return 2;
  }
  contact = rs_contact_new(argv[1], NULL, 0, &error);
  if (!contact) {
    printf("%s\n", error.message);
    return error.code;
  }
  memset(&state, 0, sizeof(state));
  state.size = sizeof(state);
  state.given = RS_LATERAL_SHIFT | RS_CREEPAGE_X | RS_LOAD;
  state.lateral_shift = 1e-3;
  state.creepage_x = -1e-3;
  state.load = 80e3;
  forces.size = sizeof(forces);
  if (rs_solve(contact, &state, &forces, &error) || rs_stress(contact, RS_RAIL, below, 1, stress, &error)) {
    printf("%s\n", error.message);
    return error.code;
  }
  printf("%.12e %.12e %.12e\n", forces.force_x, forces.p_max, stress[2]);
  state.friction = -1;
  state.given |= RS_FRICTION;
  if (rs_solve(contact, &state, &forces, &error) != RS_CASE || !strstr(error.message, "friction")) return 1;
  rs_contact_free(contact);
  return fabs(forces.force_z - 80e3) < 80 ? 0 : 1;
}
