! The same contact as in mine.c, from Fortran 2003 with the module railstrata.f90, which is installed beside
! railstrata.h.
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
