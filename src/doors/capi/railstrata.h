/* RailStrata for other programs, in C: one wheel on one rail, with layers, by half-spaces. C89; from Fortran by
 * bind(c), from C++ as it is. The C++ interface is railstrata.hpp.
 *
 * Units are SI. Axes and signs are those of docs/conventions.md: x the rolling direction, y lateral towards the field
 * side, z up; forces act on the wheel; creepages are the rigid slip of the wheel over the rail divided by the speed, a
 * driving wheel has creepage_x < 0 and force_x > 0; tractions of fields act on the rail.
 *
 * Threads: a contact belongs to one thread at a time; several contacts may be solved at once. Nothing is printed or
 * written, no signal is caught, the process is never ended. Contacts share what FFTW keeps, copies of one their
 * influence functions too; both are guarded.
 *
 * Structs begin with their size, sizeof as your compiler has it, which you set in those that are filled too. Later
 * versions add members at the end. A smaller size, of an older header from 0.4.0 on, is taken: members that it lacks
 * are 0 and are not written. A larger size, of a newer header than the library, is refused. Elements of an array are of
 * one size. rs_wheel has no size and stays as it is.
 *
 * Functions that can fail return 0 or a pointer on success; else the code of the error, or NULL, and fill `error`,
 * which may be NULL. */
#ifndef RAILSTRATA_H
#define RAILSTRATA_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define RS_API __attribute__((visibility("default")))
#else
#define RS_API
#endif

/* Of rs_error.code; the program's exit codes have the same meanings. */
#define RS_OK 0
#define RS_CASE 2     /* a mistake: an input is misspelt, out of range or at odds with another */
#define RS_NUMERICS 3 /* an iteration did not converge */
#define RS_MACHINE 4  /* not enough memory, a file that cannot be read */
#define RS_NO_ANSWER                                                                                                   \
  5                    /* physics: the inputs are in range, and no contact has them. Friction cannot bear the force or \
                        * wedges the wheel; the wheel misses the rail or touches at the end of a profile; the load     \
                        * flattens the patch */
#define RS_INTERNAL 70 /* a fault of the library */

typedef struct rs_error {
  int code;
  char message[1000]; /* what is wrong and what to do; cut if it is longer */
} rs_error;

/* A wheel on a rail. It keeps its last solution. */
typedef struct rs_contact rs_contact;

/* 10000 major + 100 minor + patch. */
RS_API int rs_version(void);

/* A contact from a case file (docs/case-reference.md) with `count` overrides "key=value", as --set of the program takes
 * them. The text form takes the case itself; profile names are then relative to the working folder. */
RS_API rs_contact* rs_contact_new(const char* case_file, const char* const* overrides, int count, rs_error* error);
RS_API rs_contact* rs_contact_from_text(const char* toml, const char* const* overrides, int count, rs_error* error);
/* A copy with its last solution and where the next one starts from, so that both go on with the same bits: a workspace
 * for another thread. It costs no reading and no influence functions, which copies share. Of a contact of a wheelset
 * too: the copy is yours to free. */
RS_API rs_contact* rs_contact_copy(const rs_contact* contact, rs_error* error);
/* NULL is allowed, and a contact of a wheelset, which stays: rs_wheelset_free ends it. */
RS_API void rs_contact_free(rs_contact* contact);

/* A number of the contact's case by its key (docs/case-reference.md), SI: "material.rail.young", "layer.0.thickness",
 * "geometry.wheel_radius"; of a switch 0 or 1. NaN: the case gives none. Errors: RS_CASE for a key that is none or no
 * single number. Of a wheelset's case by rs_wheelset_contact. */
RS_API int rs_contact_number(const rs_contact* contact, const char* key, double* out, rs_error* error);

/* Bits of rs_state.given. */
#define RS_LOAD 1u
#define RS_APPROACH 2u
#define RS_LATERAL_SHIFT 4u
#define RS_YAW 8u
#define RS_ROLL 16u
#define RS_SPEED 32u
#define RS_FRICTION 64u
#define RS_CREEPAGE_X 128u
#define RS_CREEPAGE_Y 256u
#define RS_SPIN 512u
#define RS_FORCE_X 1024u
#define RS_FORCE_Y 2048u

/* What is different from the case in one solution. Members whose bit is not set in `given` are not read. */
typedef struct rs_state {
  size_t size;          /* sizeof(rs_state) */
  unsigned given;       /* RS_LOAD | ... */
  double load;          /* N, vertical, on the rail; or approach */
  double approach;      /* m, of the bodies along the contact normal: the load is a result */
  double lateral_shift; /* m, of the wheel to the field side */
  double yaw, roll;  /* tangents of angle of attack and roll, as the case's; rs_wheelset_state has the angles in rad */
  double speed;      /* m/s; below 0.01, also at a standstill, that of 0.01; < 0 as > 0: x is the rolling direction */
  double friction;   /* coefficient at rest */
  double creepage_x; /* (V - omega r) / V, negative drives; or force_x */
  double creepage_y; /* lateral, in the contact plane; or force_y */
  double spin;       /* 1/m; without it that of the geometry */
  double force_x;    /* N, longitudinal, on the wheel */
  double force_y;    /* N, lateral friction on the wheel, in the contact plane */
} rs_state;

/* What a contact gives. NaN: does not apply. Of several patches: forces of all, the rest of the one with the largest
 * pressure. */
typedef struct rs_forces {
  size_t size;                        /* sizeof(rs_forces), to be set by the caller */
  double force_x, force_y, force_z;   /* N, on the wheel, model frame */
  double normal_force, lateral_force; /* N, along the contact normal and across it, on the wheel */
  double spin_moment;                 /* N m, on the wheel about the contact normal */
  double creepage_x, creepage_y;      /* as given, or found for the forces */
  double spin;                        /* 1/m */
  double approach;                    /* m */
  double contact_angle;               /* rad */
  double p_max, q_max;                /* Pa */
  double patch_area, slip_area;       /* m2 */
  double dissipation;                 /* W, in the patch */
  int patches;                        /* contacts that share the load */
  int cells;                          /* with pressure, of the first patch */
  int iterations;                     /* products with the influence matrix */
  int checks_hold;                    /* every check of the result holds; the remarks name those that do not */
  int beyond;                         /* not 0: NO SOLUTION but its continuation beyond what half-spaces bear */
  int reserved;
} rs_forces;

/* Side of the cells [m], 0.02e-3 to 5e-3; 0.25e-3 unless set. */
RS_API int rs_set_cell(rs_contact* contact, double cell, rs_error* error);

/* Tolerance of solutions, 1e-12 to 1e-3; 1e-5 unless set. The largest slip in sticking cells over the largest rigid
 * slip, the error of forces that friction bears over friction, that of the vertical force over the load; of the gap in
 * contact over its range a hundredth. Sharper ones cost about a Newton step for every two digits. A solution that
 * starts from the one before takes out 99 % of what the state's change made wrong as well, however little that is. */
RS_API int rs_set_tolerance(rs_contact* contact, double tolerance, rs_error* error);

/* Solves the case with what `state` changes of it; NULL: as it is. After an error the last solution is gone. A wheel
 * that is lifted (approach <= 0, or load 0) is an answer: RS_OK with forces, patches and cells 0; the next solution
 * starts from the last contact.
 * An approach that flattens the patch (a trial step of an integrator, beyond about 1.5 mm, near a flange 0.4 mm) is
 * RS_OK with `beyond` = 1 and checks_hold = 0: forces and spin moment grow along the line through those of the two
 * largest of the approaches 10 um 1.1^k that half-spaces bear, all else is of the largest of these. Such forces serve
 * to reject or shorten the step, not as a result: test `beyond` before you keep a step. Where a load is given, or the
 * size of rs_forces is an older one without `beyond`, it is RS_NO_ANSWER. */
RS_API int rs_solve(rs_contact* contact, const rs_state* state, rs_forces* forces, rs_error* error);

/* rs_solve of n contacts, each with its state, over threads (0: as many as OpenMP gives the calling thread); the same
 * bits for any number of them. errors: n, or NULL; each is that of its contact. Returns 0, or the code of the first
 * that is not. A mistake of the call itself (a contact that appears twice, threads < 0) solves nothing and is every
 * error. */
RS_API int rs_solve_many(int n, rs_contact* const* contacts, const rs_state* states, rs_forces* forces,
                         rs_error* errors, int threads);

/* Derivatives of the last solution by one input of rs_state: of the members of rs_forces, in their units per that of
 * the input. */
typedef struct rs_derivatives {
  size_t size;                      /* sizeof(rs_derivatives), to be set by the caller */
  double force_x, force_y, force_z; /* N per unit of the input, and so on */
  double normal_force, lateral_force;
  double spin_moment;
  double creepage_x, creepage_y, spin;
  double approach;
  double contact_angle;
} rs_derivatives;

/* Derivatives of what rs_solve gave, by `count` inputs, each one bit of rs_state.given; out[k] is that of inputs[k].
 * All other inputs stay as they were given; what was not given follows as in rs_solve: by RS_YAW the lateral creepage
 * turns with the wheel unless RS_CREEPAGE_Y was given. The equations of the cells in contact, sticking and slipping,
 * linearised at the last solution, so that errors are those of its sets: some 1e-4 after a tolerance of 1e-5, 1e-6
 * after 1e-8. Six inputs cost three to eight warm solutions. Where a derivative jumps (a cell comes into contact, a
 * profile's curvature changes) it is that of one side. Of several patches in one plane force_x, force_y and force_z are
 * those of rs_forces; all else is of the whole plane, where rs_forces has one patch.
 * Without linear equations (patches in planes of their own, friction that falls with slip or temperature, a film that
 * yields, a force over a given approach) by central differences of new solutions of a tolerance of 1e-10, several times
 * dearer. Of a lifted wheel all are 0. After an answer that is `beyond`, those of the solution that it is
 * continued from. Errors: RS_CASE without a solution, for an input that the last state has as a result (a load
 * where the approach was given, a creepage where a force was); as rs_solve. */
RS_API int rs_jacobian(rs_contact* contact, const unsigned* inputs, int count, rs_derivatives* out, rs_error* error);

/* Solutions start from the one before, which halves their time in a sweep; their numbers then depend on it in the sixth
 * digit. Discards it: the next solution has the bits of a new contact's first. */
RS_API void rs_forget(rs_contact* contact);

/* The checks that fail and the notes of the last solution and of profiles that were read (a z that was shifted), one a
 * line; "" if there are none. Belongs to the contact, until its next call. */
RS_API const char* rs_remarks(rs_contact* contact);

/* Points of the last solution: along x and across, point (i, j) at index j + ny i. Of patch 0, 1, ... */
RS_API int rs_points(const rs_contact* contact, int patch, int* nx, int* ny, rs_error* error);

/* Fields of rs_field. */
#define RS_X 0
#define RS_Y 1
#define RS_Z 2
#define RS_AREA 3
#define RS_PRESSURE 4
#define RS_TRACTION_X 5
#define RS_TRACTION_Y 6
#define RS_SLIP_X 7
#define RS_SLIP_Y 8
#define RS_STATE 9 /* 0 separated, 1 stick, 2 slip */

/* Copies a field of the last solution to out[0 .. n-1], n = nx ny. SI. */
RS_API int rs_field(const rs_contact* contact, int patch, int field, double* out, size_t n, rs_error* error);

/* One of the patches that share the load, 0 (the largest pressure) to rs_forces.patches - 1. Model axes: x along
 * rolling from the middle of the wheel's tape circle, y to the field side, z up, from the origin of the rail's profile.
 * Contacts that lie close are solved in one plane, whose normal their pressure acts along; where their patches are not
 * connected each is one of these, with the place and the contact angle of its own on the profiles. */
typedef struct rs_patch {
  size_t size;                        /* sizeof(rs_patch), to be set by the caller */
  double force[3];                    /* N, on the wheel */
  double moment[3];                   /* N m, of its tractions on the wheel, sum of (r - about) x dF */
  double normal_force, lateral_force; /* N, along the plane's normal and across it, on the wheel */
  double spin_moment;                 /* N m, on the wheel about the plane's normal through `point` */
  double approach;                    /* m, along that normal */
  double point[3];                    /* m, where the rigid bodies touch */
  double on_wheel[2], on_rail[2];     /* m, y and z of it in the profiles' own axes, y to the field side */
  double contact_angle;               /* rad, of the common tangent to y */
  double rolling_radius;              /* m */
  double p_max;                       /* Pa */
  double patch_area;                  /* m2 */
  double dissipation;                 /* W */
  int cells;                          /* with pressure */
  int reserved;
} rs_patch;

/* A patch of the last solution. about: the point [m, model axes] that moments are about; NULL: the origin. Forces of
 * all patches add up to those of rs_forces, as in rs_wheelset_patch. Errors: RS_CASE without a solution, of a lifted
 * wheel (it has no patch), for a patch that is not there. */
RS_API int rs_patch_forces(const rs_contact* contact, int patch, const double* about, rs_patch* out, rs_error* error);

/* Stresses [Pa] at n points below (rail) or above (wheel) the patch of the largest pressure. xyz: n times x, y from the
 * contact point along the rolling direction and the common tangent, and the depth into the body [m]. out: n times
 * xx, yy, zz, xy, yz, xz in these axes. */
#define RS_RAIL 0
#define RS_WHEEL 1
RS_API int rs_stress(const rs_contact* contact, int body, const double* xyz, size_t n, double* out, rs_error* error);

/* Takes a profile from an array in place of the case's: worn, or another one each step. body: RS_RAIL or RS_WHEEL; yz:
 * n points y, z [m] in the order along the curve, as a file of two columns has them (docs/conventions.md: smoothed and
 * turned alike). The last solution is gone, the next one starts from it. Of both sides of a wheelset by
 * rs_wheelset_contact; of its right wheel too y is to the field side. Errors: RS_CASE, and the old profile stays: no
 * profile of this kind, or the case's place has no contact with it. */
RS_API int rs_set_profile(rs_contact* contact, int body, const double* yz, size_t n, rs_error* error);

/* A creep-force table of `railstrata creep --axis` (creep_table.h5): numbers over axes, some ten microseconds and less
 * an answer. Several threads may ask one table at a time. */
typedef struct rs_table rs_table;

RS_API rs_table* rs_table_open(const char* file, rs_error* error);
/* NULL is allowed. */
RS_API void rs_table_close(rs_table* table);

/* Axes and numbers of a table, by index from 0: names, units (SI; "" of a plain number) and the ends of an axis. NULL
 * or NaN: there is none of this index. The texts belong to the table. */
RS_API int rs_table_axes(const rs_table* table);
RS_API const char* rs_table_axis(const rs_table* table, int axis);
RS_API const char* rs_table_axis_unit(const rs_table* table, int axis);
RS_API double rs_table_axis_first(const rs_table* table, int axis);
RS_API double rs_table_axis_last(const rs_table* table, int axis);
RS_API int rs_table_numbers(const rs_table* table);
RS_API const char* rs_table_number(const rs_table* table, int number);
RS_API const char* rs_table_number_unit(const rs_table* table, int number);

/* Interpolates, linear along every axis (of a scaled table cubic along its own, which are not seen here: docs/
 * creep-table.md): `at` has a value for each axis, `out` room for each number. A number is NaN
 * where a corner of the cell around has no answer. Returns how many values of `at` lie beyond their axis, by more than
 * 1e-9 of it: these are taken at its end, where the numbers may be far from those of the contact. -1: `table`, `at` or
 * `out` is NULL, or a value is NaN. */
RS_API int rs_table_at(const rs_table* table, const double* at, double* out);

/* A wheelset: two wheels on one rigid axle and their rails. Its axes are those of the track: x along it, y to the left,
 * z up, from the middle of the track at the height of the rails' origins. The centre of the axle stands at (0, y, r0 +
 * z), r0 the case's wheel_radius; the wheelset is turned by the roll about x, then by the yaw about z. Creepages and
 * spin follow from the rigid motion at the contacts, w and Omega, over c = max(|V|, |w|, 0.01 m/s), the same whether it
 * rolls on or back: docs/vehicle.md. A wheelset that stands has forces against its slip. */
typedef struct rs_wheelset rs_wheelset;
#define RS_LEFT 0
#define RS_RIGHT 1

/* A case is that of the left wheel, whose model axes are these; the right wheel is its mirror image, with `right`, its
 * own overrides: "geometry.rail_profile=worn.prr". Each wheel stands at half of the back-to-back distance, each gauge
 * face at half of the gauge. Position, motion and load of the case do not count. */
RS_API rs_wheelset* rs_wheelset_new(const char* case_file, const char* const* overrides, int count,
                                    const char* const* right, int right_count, rs_error* error);
RS_API rs_wheelset* rs_wheelset_from_text(const char* toml, const char* const* overrides, int count,
                                          const char* const* right, int right_count, rs_error* error);
/* As rs_contact_copy; what was kept is copied too. */
RS_API rs_wheelset* rs_wheelset_copy(const rs_wheelset* wheelset, rs_error* error);
/* NULL is allowed. */
RS_API void rs_wheelset_free(rs_wheelset* wheelset);

/* Bits of rs_wheelset_state.given: RS_WHEELSET_Z | RS_WHEELSET_ROLL presses each wheel by its own approach, loads are
 * results. RS_WHEELSET_LOAD | RS_WHEELSET_ROLL: z is found. RS_WHEELSET_LOAD: z and roll are found, so that the
 * contacts bear the load and the roll moment, for vehicles without vertical and roll inertia of the wheelset. */
#define RS_WHEELSET_Z 1u
#define RS_WHEELSET_ROLL 2u
#define RS_WHEELSET_LOAD 4u

typedef struct rs_wheelset_state {
  size_t size;                 /* sizeof(rs_wheelset_state) */
  unsigned given;              /* of z, roll and load, those to be read. All else is read: 0 where nothing moves */
  double y, z, yaw, roll;      /* m, and angles in rad, where rs_state has their tangents */
  double speed;                /* m/s along the track, V; 0 stands, < 0 rolls back */
  double y_rate, z_rate;       /* m/s */
  double yaw_rate, roll_rate;  /* rad/s; on the inside of a curve of radius R yaw_rate has speed / R besides */
  double pitch_rate;           /* rad/s, of the axle beyond speed / r0: > 0 drives */
  double load;                 /* N, on the axle, down */
  double roll_moment;          /* N m, on the axle about x; with a load and no roll */
  double rail_y[2], rail_z[2]; /* m, of the left and the right rail: irregularity, deflection */
  double rail_roll[2];         /* rad, about x through the origins of their profiles */
  double rail_y_rate[2], rail_z_rate[2]; /* m/s, of the rails' material: deflection, not irregularity */
  double wheel_pitch_rate[2]; /* rad/s, of the left and the right wheel beyond that of the axle: independent wheels */
  double rail_yaw[2];         /* rad, about z through the places of their tape circles at x = 0 */
} rs_wheelset_state;

/* One wheel of a wheelset, in the track's axes: of the right one, angles, spins and lateral numbers have the sign that
 * they have seen from behind. Of several patches: forces of all, the rest as rs_forces has it. */
typedef struct rs_wheel {
  double force[3];                    /* N, on the wheel */
  double moment[3];                   /* N m, of the contact on the wheelset, about its centre */
  double normal_force, lateral_force; /* N, along the contact normal and across it, on the wheel */
  double spin_moment;                 /* N m, on the wheel about the contact normal */
  double creepage_x, creepage_y;      /* at point */
  double spin;                        /* 1/m, there */
  double approach;                    /* m, along the normal there; < 0: lifted */
  double point[3]; /* m, of the patch, or between several; from the middle of the track below the centre */
  double on_wheel[2], on_rail[2]; /* m, y and z of it in the profiles' own axes, y to the field side */
  double contact_angle;           /* rad, of the common tangent to y */
  double rolling_radius;          /* m */
  double p_max;                   /* Pa */
  double patch_area;              /* m2 */
  double dissipation;             /* W, in the patch */
  int patches, cells;             /* 0: lifted, which is an answer */
  int checks_hold;                /* every check of the result holds */
  int beyond;                     /* not 0: NO SOLUTION but its continuation beyond what half-spaces bear */
} rs_wheel;

typedef struct rs_wheelset_forces {
  size_t size;                /* sizeof(rs_wheelset_forces), to be set by the caller */
  double z, roll;             /* m, rad; as given, or found */
  double force[3], moment[3]; /* N, N m, of both contacts on the wheelset about its centre */
  rs_wheel wheel[2];          /* RS_LEFT, RS_RIGHT */
  int solutions;              /* of each contact, that the state took */
  int reserved;
  int beyond; /* wheels whose forces are NO SOLUTION but its continuation: see rs_solve */
  int reserved2;
} rs_wheelset_forces;

/* Solves a state. After an error the last solution is gone. A height (RS_WHEELSET_Z) that presses a wheel too far:
 * RS_OK with `beyond`, as rs_solve; what the cells do not carry acts at rs_wheel.point. RS_NO_ANSWER: of rs_solve; the
 * roll moment tips the wheelset over, with what each wheel bears alone. */
RS_API int rs_wheelset_solve(rs_wheelset* wheelset, const rs_wheelset_state* state, rs_wheelset_forces* forces,
                             rs_error* error);

/* As rs_solve_many. */
RS_API int rs_wheelset_solve_many(int n, rs_wheelset* const* wheelsets, const rs_wheelset_state* states,
                                  rs_wheelset_forces* forces, rs_error* errors, int threads);

/* Inputs of rs_wheelset_jacobian, members of rs_wheelset_state; of those with two numbers that of the left rail or
 * wheel, with RS_OF_RIGHT added that of the right one. */
#define RS_BY_Y 0
#define RS_BY_Z 1
#define RS_BY_YAW 2
#define RS_BY_ROLL 3
#define RS_BY_SPEED 4
#define RS_BY_Y_RATE 5
#define RS_BY_Z_RATE 6
#define RS_BY_YAW_RATE 7
#define RS_BY_ROLL_RATE 8
#define RS_BY_PITCH_RATE 9
#define RS_BY_LOAD 10
#define RS_BY_ROLL_MOMENT 11
#define RS_BY_RAIL_Y 12
#define RS_BY_RAIL_Z 13
#define RS_BY_RAIL_ROLL 14
#define RS_BY_RAIL_Y_RATE 15
#define RS_BY_RAIL_Z_RATE 16
#define RS_BY_WHEEL_PITCH_RATE 17
#define RS_BY_RAIL_YAW 18
#define RS_OF_RIGHT 32

/* Derivatives of what rs_wheelset_solve gave by one input, in SI units per unit of the input; as rs_wheelset_forces. */
typedef struct rs_wheelset_derivatives {
  size_t size; /* sizeof(rs_wheelset_derivatives), to be set by the caller */
  double z, roll;
  double force[3], moment[3];
  double left_force[3], left_moment[3]; /* of the contact on the left wheel, moment about the wheelset's centre */
  double right_force[3], right_moment[3];
} rs_wheelset_derivatives;

/* Derivatives of the last solution by `count` inputs, RS_BY_Y and so on; out[k] is that of inputs[k]. All other numbers
 * of the state stay; z and roll that were found follow, so that load and roll moment stay. By the linear equations of
 * the cells in contact, as rs_jacobian, one solution of these a wheel and input; where there are none, by differences
 * of two solutions. Of a lifted wheel 0. Errors: RS_CASE without a solution, for a number that is a result of the last
 * state; as rs_wheelset_solve. */
RS_API int rs_wheelset_jacobian(rs_wheelset* wheelset, const int* inputs, int count, rs_wheelset_derivatives* out,
                                rs_error* error);

/* A patch of the last solution as rs_patch_forces gives it, but in the track's axes, signs as in rs_wheel. about: the
 * point [m, track axes] that moments are about; NULL: the centre of the wheelset. Patches of a wheel add up to its
 * force and moment; where two places are on the way into one plane (a remark reports it) within 1 %, for the wheel has
 * means of solutions and the patches are those of one. Errors: RS_CASE without a solution, of a lifted wheel, for a
 * side or a patch that is not there. */
RS_API int rs_wheelset_patch(const rs_wheelset* wheelset, int side, int patch, const double* about, rs_patch* out,
                             rs_error* error);

/* rs_remarks of both wheels, each line begins with its wheel: "left wheel: ". Belongs to the wheelset, until its next
 * call. */
RS_API const char* rs_wheelset_remarks(const rs_wheelset* wheelset);

/* Solutions start from the ones before. Trial steps of an integrator: rs_wheelset_keep remembers where the next
 * solution starts from, rs_wheelset_reset returns there; what follows has the bits of what followed the first time.
 * rs_wheelset_forget starts anew. */
RS_API void rs_wheelset_keep(rs_wheelset* wheelset);
RS_API void rs_wheelset_reset(rs_wheelset* wheelset);
RS_API void rs_wheelset_forget(rs_wheelset* wheelset);

/* The contact of a side, of the last solution: for rs_field, rs_stress, rs_set_cell, rs_set_tolerance (of both sides).
 * In its own axes, those of a left wheel on its rail that rolls on: of the right wheel and of one that rolls back those
 * of the mirror. Belongs to the wheelset. NULL: no such side. */
RS_API rs_contact* rs_wheelset_contact(rs_wheelset* wheelset, int side);

#ifdef __cplusplus
}
#endif
#endif
