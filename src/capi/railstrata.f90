! railstrata.h for Fortran 2003: wheelsets and creep tables. Meanings, units and signs stand there. Arrays count from 1: wheel(1) and
! rail_y(1) are the left ones.
module railstrata
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: rs_ok = 0, rs_left = 0, rs_right = 1
  integer(c_int), parameter :: rs_wheelset_z = 1, rs_wheelset_roll = 2, rs_wheelset_load = 4

  type, bind(c) :: rs_error
    integer(c_int) :: code = 0
    character(kind=c_char) :: message(1000)
  end type

  type, bind(c) :: rs_wheelset_state
    integer(c_size_t) :: size
    integer(c_int) :: given
    real(c_double) :: y = 0, z = 0, yaw = 0, roll = 0, speed = 0, y_rate = 0, z_rate = 0, yaw_rate = 0, &
                      roll_rate = 0, pitch_rate = 0, load = 0, roll_moment = 0
    real(c_double), dimension(2) :: rail_y = 0, rail_z = 0, rail_roll = 0, rail_y_rate = 0, rail_z_rate = 0
  end type

  type, bind(c) :: rs_wheel
    real(c_double) :: force(3), moment(3), normal_force, lateral_force, spin_moment, creepage_x, creepage_y, spin, &
                      approach, point(3), on_wheel(2), on_rail(2), contact_angle, rolling_radius, p_max, &
                      patch_area, dissipation
    integer(c_int) :: patches, cells, checks_hold, reserved
  end type

  type, bind(c) :: rs_wheelset_forces
    integer(c_size_t) :: size
    real(c_double) :: z, roll, force(3), moment(3)
    type(rs_wheel) :: wheel(2)
    integer(c_int) :: solutions, reserved
  end type

  interface
    function rs_wheelset_new(case_file, overrides, count, right, right_count, error) bind(c) result(wheelset)
      import
      character(kind=c_char), intent(in) :: case_file(*)
      type(c_ptr), value :: overrides, right
      integer(c_int), value :: count, right_count
      type(rs_error), intent(out) :: error
      type(c_ptr) :: wheelset
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

    function rs_table_numbers(table) bind(c) result(count)
      import
      type(c_ptr), value :: table
      integer(c_int) :: count
    end function

    function rs_table_at(table, at, out) bind(c) result(beyond)
      import
      type(c_ptr), value :: table
      real(c_double), intent(in) :: at(*)
      real(c_double), intent(out) :: out(*)
      integer(c_int) :: beyond
    end function
  end interface
end module
