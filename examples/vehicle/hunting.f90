! The wheelset of hunting.c. usage: hunting CASE SPEED SPRINGS STEP LENGTH
program hunting
  use railstrata
  implicit none
  real(c_double), parameter :: mass = 1500, inertia = 1000, stiffness_y = 2d6, &
                               stiffness_yaw = 2d6, load = 160d3, radius = 0.46d0, &
                               pi = 3.14159265358979324d0, gamma = 1 - sqrt(0.5d0)
  real(c_double) :: pitch_rate = 0, speed, springs, step, length, x, h, q(4) = 0, one(4), two(4), jacobian(4, 4)
  type(c_ptr) :: wheelset
  type(rs_wheelset_forces) :: forces
  type(rs_error) :: error
  character(len=1000) :: file
  integer :: side

  call get_command_argument(1, file)
  speed = argument(2)
  springs = argument(3)
  step = argument(4)
  length = argument(5)
  wheelset = rs_wheelset_new(trim(file)//c_null_char, c_null_ptr, 0_c_int, c_null_ptr, 0_c_int, error)
  if (.not. c_associated(wheelset)) call stop_with(error)
  do side = rs_left, rs_right
    if (rs_set_cell(rs_wheelset_contact(wheelset, side), 1d-3, error) /= rs_ok) call stop_with(error)
  end do
  forces%size = c_sizeof(forces)
  one = rates(0d0, q)
  pitch_rate = speed/forces%wheel(1)%rolling_radius - speed/radius
  call differentiate()
  print '(a)', 'x_m,y_mm,yaw_mrad,radius_difference_mm'
  x = 0
  do while (x < length)
    h = step/speed
    one = rates(x, q)
    print '(f0.4,3(",",f0.7))', x, 1d3*q(1), 1d3*q(2), &
      1d3*(forces%wheel(1)%rolling_radius - forces%wheel(2)%rolling_radius)
    one = solved(gamma*h, one)
    two = solved(gamma*h, rates(x + step, q + h*one) - 2*one)
    q = q + h*(1.5d0*one + 0.5d0*two)
    x = x + step
  end do
  call rs_wheelset_free(wheelset)

contains

  real(c_double) function argument(k)
    integer, intent(in) :: k
    character(len=100) :: text
    call get_command_argument(k, text)
    read (text, *) argument
  end function

  function rates(x, q) result(out)
    real(c_double), intent(in) :: x, q(4)
    real(c_double) :: out(4)
    type(rs_wheelset_state) :: s
    s%size = c_sizeof(s)
    s%given = rs_wheelset_load
    s%load = load
    s%speed = speed
    s%pitch_rate = pitch_rate
    s%y = q(1)
    s%yaw = q(2)
    s%y_rate = q(3)
    s%yaw_rate = q(4)
    s%rail_y = 0.25d-3*(1 - cos(pi*min(x, 2d0)/2))
    if (rs_wheelset_solve(wheelset, s, forces, error) /= rs_ok) call stop_with(error)
    out = [q(3), q(4), (forces%force(2) - springs*stiffness_y*q(1))/mass, &
           (forces%moment(3) - springs*stiffness_yaw*q(2))/inertia]
  end function

  subroutine differentiate()
    real(c_double), parameter :: small(4) = [1d-4, 1d-4, 1d-3, 1d-3]
    real(c_double) :: moved(4), more(4)
    integer :: j
    do j = 1, 4
      moved = 0
      moved(j) = small(j)
      more = rates(0d0, moved)
      jacobian(:, j) = (more - rates(0d0, -moved))/(2*small(j))
    end do
  end subroutine

  function solved(factor, right) result(b)
    real(c_double), intent(in) :: factor, right(4)
    real(c_double) :: a(4, 4), b(4), share
    integer :: i, k
    a = -factor*jacobian
    do k = 1, 4
      a(k, k) = a(k, k) + 1
    end do
    b = right
    do k = 1, 4
      do i = 1, 4
        if (i == k) cycle
        share = a(i, k)/a(k, k)
        a(i, :) = a(i, :) - share*a(k, :)
        b(i) = b(i) - share*b(k)
      end do
    end do
    do k = 1, 4
      b(k) = b(k)/a(k, k)
    end do
  end function

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
