! railstrata.h for Fortran 2003. Meanings, units and signs stand there. Arrays count from 1: wheel(1) and rail_y(1) are
! the left ones; patches, axes and numbers of a table count from 0 as there.
module railstrata
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: rs_by_y = 0, rs_by_z = 1, rs_by_yaw = 2, rs_by_roll = 3, rs_by_speed = 4, &
    rs_by_y_rate = 5, rs_by_z_rate = 6, rs_by_yaw_rate = 7, rs_by_roll_rate = 8, rs_by_pitch_rate = 9, &
    rs_by_load = 10, rs_by_roll_moment = 11, rs_by_rail_y = 12, rs_by_rail_z = 13, rs_by_rail_roll = 14, &
    rs_by_rail_y_rate = 15, rs_by_rail_z_rate = 16, rs_by_wheel_pitch_rate = 17, rs_by_rail_yaw = 18, rs_of_right = 32
  integer(c_int), parameter :: rs_ok = 0, rs_left = 0, rs_right = 1, rs_rail = 0, rs_wheel_body = 1
  integer(c_int), parameter :: rs_load = 1, rs_approach = 2, rs_lateral_shift = 4, rs_yaw = 8, rs_roll = 16, &
    rs_speed = 32, rs_friction = 64, rs_creepage_x = 128, rs_creepage_y = 256, rs_spin = 512, rs_force_x = 1024, &
    rs_force_y = 2048
  integer(c_int), parameter :: rs_x = 0, rs_y = 1, rs_z = 2, rs_area = 3, rs_pressure = 4, rs_traction_x = 5, &
                               rs_traction_y = 6, rs_slip_x = 7, rs_slip_y = 8, rs_point_state = 9
  integer(c_int), parameter :: rs_wheelset_z = 1, rs_wheelset_roll = 2, rs_wheelset_load = 4

  type, bind(c) :: rs_error
    integer(c_int) :: code = 0
    character(kind=c_char) :: message(1000)
  end type

  type, bind(c) :: rs_state
    integer(c_size_t) :: size
    integer(c_int) :: given = 0
    real(c_double) :: load = 0, approach = 0, lateral_shift = 0, yaw = 0, roll = 0, speed = 0, friction = 0, &
      creepage_x = 0, creepage_y = 0, spin = 0, force_x = 0, force_y = 0
  end type

  type, bind(c) :: rs_forces
    integer(c_size_t) :: size
    real(c_double) :: force_x, force_y, force_z, normal_force, lateral_force, spin_moment, creepage_x, creepage_y, &
      spin, approach, contact_angle, p_max, q_max, patch_area, slip_area, dissipation
    integer(c_int) :: patches, cells, iterations, checks_hold, beyond, reserved
  end type

  type, bind(c) :: rs_derivatives
    integer(c_size_t) :: size
    real(c_double) :: force_x, force_y, force_z, normal_force, lateral_force, spin_moment, creepage_x, creepage_y, &
      spin, approach, contact_angle
  end type

  type, bind(c) :: rs_patch
    integer(c_size_t) :: size
    real(c_double) :: force(3), moment(3), normal_force, lateral_force, spin_moment, approach, point(3), on_wheel(2), &
      on_rail(2), contact_angle, rolling_radius, p_max, patch_area, dissipation
    integer(c_int) :: cells, reserved
  end type

  type, bind(c) :: rs_wheelset_state
    integer(c_size_t) :: size
    integer(c_int) :: given = 0
    real(c_double) :: y = 0, z = 0, yaw = 0, roll = 0, speed = 0, y_rate = 0, z_rate = 0, yaw_rate = 0, roll_rate = 0, &
      pitch_rate = 0, load = 0, roll_moment = 0, rail_y(2) = 0, rail_z(2) = 0, rail_roll(2) = 0, rail_y_rate(2) = 0, &
      rail_z_rate(2) = 0, wheel_pitch_rate(2) = 0, rail_yaw(2) = 0
  end type

  type, bind(c) :: rs_wheel
    real(c_double) :: force(3), moment(3), normal_force, lateral_force, spin_moment, creepage_x, creepage_y, spin, &
      approach, point(3), on_wheel(2), on_rail(2), contact_angle, rolling_radius, p_max, patch_area, dissipation
    integer(c_int) :: patches, cells, checks_hold, beyond
  end type

  type, bind(c) :: rs_wheelset_forces
    integer(c_size_t) :: size
    real(c_double) :: z, roll, force(3), moment(3)
    type(rs_wheel) :: wheel(2)
    integer(c_int) :: solutions, reserved, beyond, reserved2
  end type

  type, bind(c) :: rs_wheelset_derivatives
    integer(c_size_t) :: size
    real(c_double) :: z, roll, force(3), moment(3), left_force(3), left_moment(3), right_force(3), right_moment(3)
  end type

  interface
    function rs_version() bind(c) result(version)
      import
      integer(c_int) :: version
    end function

    function rs_contact_new(case_file, overrides, count, error) bind(c) result(contact)
      import
      character(kind=c_char), intent(in) :: case_file(*)
      type(c_ptr), value :: overrides
      integer(c_int), value :: count
      type(rs_error), intent(out) :: error
      type(c_ptr) :: contact
    end function

    function rs_contact_from_text(toml, overrides, count, error) bind(c) result(contact)
      import
      character(kind=c_char), intent(in) :: toml(*)
      type(c_ptr), value :: overrides
      integer(c_int), value :: count
      type(rs_error), intent(out) :: error
      type(c_ptr) :: contact
    end function

    function rs_contact_copy(contact, error) bind(c) result(copy)
      import
      type(c_ptr), value :: contact
      type(rs_error), intent(out) :: error
      type(c_ptr) :: copy
    end function

    function rs_contact_number(contact, key, number, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), intent(out) :: number
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    subroutine rs_contact_free(contact) bind(c)
      import
      type(c_ptr), value :: contact
    end subroutine

    function rs_set_tolerance(contact, tolerance, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      real(c_double), value :: tolerance
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_set_profile(contact, body, yz, n, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      integer(c_int), value :: body
      real(c_double), intent(in) :: yz(*)
      integer(c_size_t), value :: n
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_solve(contact, state, forces, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      type(rs_state), intent(in) :: state
      type(rs_forces), intent(inout) :: forces
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_solve_many(n, contacts, states, forces, errors, threads) bind(c) result(code)
      import
      integer(c_int), value :: n
      type(c_ptr), intent(in) :: contacts(*)
      type(rs_state), intent(in) :: states(*)
      type(rs_forces), intent(inout) :: forces(*)
      type(rs_error), intent(inout) :: errors(*)
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function

    function rs_jacobian(contact, inputs, count, slopes, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      integer(c_int), intent(in) :: inputs(*)
      integer(c_int), value :: count
      type(rs_derivatives), intent(inout) :: slopes(*)
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    subroutine rs_forget(contact) bind(c)
      import
      type(c_ptr), value :: contact
    end subroutine

    function rs_points(contact, patch, nx, ny, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      integer(c_int), value :: patch
      integer(c_int), intent(out) :: nx
      integer(c_int), intent(out) :: ny
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_field(contact, patch, field, values, n, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      integer(c_int), value :: patch
      integer(c_int), value :: field
      real(c_double), intent(out) :: values(*)
      integer(c_size_t), value :: n
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_patch_forces(contact, patch, about, forces, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      integer(c_int), value :: patch
      real(c_double), intent(in) :: about(*)
      type(rs_patch), intent(inout) :: forces
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_stress(contact, body, xyz, n, stress, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      integer(c_int), value :: body
      real(c_double), intent(in) :: xyz(*)
      integer(c_size_t), value :: n
      real(c_double), intent(out) :: stress(*)
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_table_open(file, error) bind(c) result(table)
      import
      character(kind=c_char), intent(in) :: file(*)
      type(rs_error), intent(out) :: error
      type(c_ptr) :: table
    end function

    subroutine rs_table_close(table) bind(c)
      import
      type(c_ptr), value :: table
    end subroutine

    function rs_table_axes(table) bind(c) result(count)
      import
      type(c_ptr), value :: table
      integer(c_int) :: count
    end function

    function rs_table_axis(table, axis) bind(c) result(name)
      import
      type(c_ptr), value :: table
      integer(c_int), value :: axis
      type(c_ptr) :: name
    end function

    function rs_table_axis_unit(table, axis) bind(c) result(unit)
      import
      type(c_ptr), value :: table
      integer(c_int), value :: axis
      type(c_ptr) :: unit
    end function

    function rs_table_axis_first(table, axis) bind(c) result(value)
      import
      type(c_ptr), value :: table
      integer(c_int), value :: axis
      real(c_double) :: value
    end function

    function rs_table_axis_last(table, axis) bind(c) result(value)
      import
      type(c_ptr), value :: table
      integer(c_int), value :: axis
      real(c_double) :: value
    end function

    function rs_table_numbers(table) bind(c) result(count)
      import
      type(c_ptr), value :: table
      integer(c_int) :: count
    end function

    function rs_table_number(table, number) bind(c) result(name)
      import
      type(c_ptr), value :: table
      integer(c_int), value :: number
      type(c_ptr) :: name
    end function

    function rs_table_number_unit(table, number) bind(c) result(unit)
      import
      type(c_ptr), value :: table
      integer(c_int), value :: number
      type(c_ptr) :: unit
    end function

    function rs_table_at(table, at, values) bind(c) result(beyond)
      import
      type(c_ptr), value :: table
      real(c_double), intent(in) :: at(*)
      real(c_double), intent(out) :: values(*)
      integer(c_int) :: beyond
    end function

    function rs_wheelset_new(case_file, overrides, count, right, right_count, error) bind(c) result(wheelset)
      import
      character(kind=c_char), intent(in) :: case_file(*)
      type(c_ptr), value :: overrides, right
      integer(c_int), value :: count, right_count
      type(rs_error), intent(out) :: error
      type(c_ptr) :: wheelset
    end function

    function rs_wheelset_copy(wheelset, error) bind(c) result(copy)
      import
      type(c_ptr), value :: wheelset
      type(rs_error), intent(out) :: error
      type(c_ptr) :: copy
    end function

    subroutine rs_wheelset_free(wheelset) bind(c)
      import
      type(c_ptr), value :: wheelset
    end subroutine

    function rs_wheelset_solve(wheelset, state, forces, error) bind(c) result(code)
      import
      type(c_ptr), value :: wheelset
      type(rs_wheelset_state), intent(in) :: state
      type(rs_wheelset_forces), intent(inout) :: forces
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_wheelset_solve_many(n, wheelsets, states, forces, errors, threads) bind(c) result(code)
      import
      integer(c_int), value :: n
      type(c_ptr), intent(in) :: wheelsets(*)
      type(rs_wheelset_state), intent(in) :: states(*)
      type(rs_wheelset_forces), intent(inout) :: forces(*)
      type(rs_error), intent(inout) :: errors(*)
      integer(c_int), value :: threads
      integer(c_int) :: code
    end function

    function rs_wheelset_jacobian(wheelset, inputs, count, slopes, error) bind(c) result(code)
      import
      type(c_ptr), value :: wheelset
      integer(c_int), intent(in) :: inputs(*)
      integer(c_int), value :: count
      type(rs_wheelset_derivatives), intent(inout) :: slopes(*)
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_wheelset_patch(wheelset, side, patch, about, forces, error) bind(c) result(code)
      import
      type(c_ptr), value :: wheelset, about  ! c_loc of three numbers, or c_null_ptr
      integer(c_int), value :: side, patch
      type(rs_patch), intent(inout) :: forces
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function

    function rs_wheelset_remarks(wheelset) bind(c) result(text)
      import
      type(c_ptr), value :: wheelset
      type(c_ptr) :: text
    end function

    subroutine rs_wheelset_keep(wheelset) bind(c)
      import
      type(c_ptr), value :: wheelset
    end subroutine

    subroutine rs_wheelset_reset(wheelset) bind(c)
      import
      type(c_ptr), value :: wheelset
    end subroutine

    subroutine rs_wheelset_forget(wheelset) bind(c)
      import
      type(c_ptr), value :: wheelset
    end subroutine

    function rs_wheelset_contact(wheelset, side) bind(c) result(contact)
      import
      type(c_ptr), value :: wheelset
      integer(c_int), value :: side
      type(c_ptr) :: contact
    end function

    function rs_set_cell(contact, cell, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      real(c_double), value :: cell
      type(rs_error), intent(out) :: error
      integer(c_int) :: code
    end function
  end interface

contains

  !> The text of a C string: of a name of a table, of an error's message by c_loc.
  function rs_text(text) result(out)
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: out
    character(kind=c_char), pointer :: letters(:)
    integer, parameter :: longest = 4096
    integer :: i
    out = ''
    if (.not. c_associated(text)) return
    call c_f_pointer(text, letters, [longest])
    do i = 1, longest
      if (letters(i) == c_null_char) exit
      out = out // letters(i)
    end do
  end function
end module
