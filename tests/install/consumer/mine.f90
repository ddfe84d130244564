! The same contact as in mine.c, from Fortran 2003 by bind(c).
module railstrata
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: rs_load = 1, rs_lateral_shift = 4, rs_creepage_x = 128, rs_rail = 0

  type, bind(c) :: rs_error
    integer(c_int) :: code
    character(kind=c_char) :: message(1000)
  end type

  type, bind(c) :: rs_state
    integer(c_size_t) :: size
    integer(c_int) :: given
    real(c_double) :: load, approach, lateral_shift, yaw, roll, speed, friction, creepage_x, creepage_y, spin, &
                      force_x, force_y
  end type

  type, bind(c) :: rs_forces
    integer(c_size_t) :: size
    real(c_double) :: force_x, force_y, force_z, normal_force, lateral_force, spin_moment, creepage_x, creepage_y, &
                      spin, approach, contact_angle, p_max, q_max, patch_area, slip_area, dissipation
    integer(c_int) :: patches, cells, iterations, checks_hold
  end type

  interface
    function rs_contact_new(case_file, overrides, count, error) bind(c) result(contact)
      import
      character(kind=c_char), intent(in) :: case_file(*)
      type(c_ptr), value :: overrides
      integer(c_int), value :: count
      type(rs_error), intent(out) :: error
      type(c_ptr) :: contact
    end function

    subroutine rs_contact_free(contact) bind(c)
      import
      type(c_ptr), value :: contact
    end subroutine

    function rs_solve(contact, state, forces, error) bind(c) result(code)
      import
      type(c_ptr), value :: contact
      type(rs_state), intent(in) :: state
      type(rs_forces), intent(inout) :: forces
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
  end interface
end module

program mine
  use railstrata
  implicit none
  type(rs_error) :: error
  type(rs_state) :: state
  type(rs_forces) :: forces
  type(c_ptr) :: contact
  real(c_double) :: below(3) = [0d0, 0d0, 2d-3], stress(6)
  character(len=1000) :: file
  if (command_argument_count() /= 1) then
    print '(a)', 'usage: mine CASE.toml'
    stop 2
  end if
  call get_command_argument(1, file)
  contact = rs_contact_new(trim(file)//c_null_char, c_null_ptr, 0_c_int, error)
  if (.not. c_associated(contact)) call stop_with(error)
  state%size = c_sizeof(state)
  state%given = ior(ior(rs_lateral_shift, rs_creepage_x), rs_load)
  state%lateral_shift = 1d-3
  state%creepage_x = -1d-3
  state%load = 80d3
  forces%size = c_sizeof(forces)
  if (rs_solve(contact, state, forces, error) /= 0) call stop_with(error)
  if (rs_stress(contact, rs_rail, below, 1_c_size_t, stress, error) /= 0) call stop_with(error)
  print '(3es22.12e3)', forces%force_x, forces%p_max, stress(3)
  call rs_contact_free(contact)

contains

  subroutine stop_with(error)
    type(rs_error), intent(in) :: error
    integer :: i
    do i = 1, size(error%message)
      if (error%message(i) == c_null_char) exit
      write (*, '(a)', advance='no') error%message(i)
    end do
    print *
    stop 2
  end subroutine
end program
