! The yarn law as an object in Fortran, and an explicit solver in twenty lines: a yarn that is pulled until it breaks.
!
!     cargo build --release -p toron-c
!     gfortran include/toron.f90 examples/fortran/yarn.f90 target/release/libtoron.a -lpthread -ldl -lm -o yarn
module yarn_law
  use, intrinsic :: iso_c_binding, only: wp => c_double, c_int32_t, c_loc, c_size_t
  use toron
  implicit none
  private

  ! Every procedure has a message, which is blank if all went well.
  type, public :: yarn
    private
    type(toron_hyperelastic_f64) :: law
    real(wp), public :: density = 0
  contains
    procedure, private :: prepare_properties, prepare_preset
    generic :: prepare => prepare_properties, prepare_preset
    procedure :: stress_at, update
  end type

contains

  ! The law with these properties and this density, in any consistent units.
  subroutine prepare_properties(self, properties, density, message)
    class(yarn), intent(inout) :: self
    real(wp), intent(in) :: properties(:), density
    character(*), intent(out) :: message
    integer(c_int32_t) :: status
    status = toron_hyperelastic_prepare(self%law, properties, message)
    self%density = density
  end subroutine

  ! The law of a yarn that the library knows, in these units.
  subroutine prepare_preset(self, preset, units, message)
    class(yarn), intent(inout) :: self
    character(*), intent(in) :: preset, units
    character(*), intent(out) :: message
    real(wp) :: properties(toron_hyperelastic_properties), density
    if (toron_preset(preset, units, properties, density, message) /= toron_status_ok) return
    call self%prepare(properties, density, message)
  end subroutine

  ! Cauchy stress 11 22 33 12 23 31 of a point that has not failed.
  subroutine stress_at(self, f, stress, message)
    class(yarn), intent(in) :: self
    real(wp), intent(in), target :: f(3, 3)
    real(wp), intent(out), target :: stress(6)
    character(*), intent(out) :: message
    type(toron_point_f64) :: point
    integer(c_int32_t) :: status
    point%deformation_gradient = c_loc(f)
    point%stress = c_loc(stress)
    status = toron_hyperelastic_point(self%law, point, message)
  end subroutine

  ! A step of a block, in arrays (elements, components): from F by columns and the old state to the new state, the stress
  ! and the wave speed.
  subroutine update(self, f, state, stress, wave_speed, message)
    class(yarn), intent(in) :: self
    real(wp), intent(in), target, contiguous :: f(:, :)
    real(wp), intent(inout), target, contiguous :: state(:, :), stress(:, :), wave_speed(:)
    character(*), intent(out) :: message
    type(toron_block_f64) :: block
    integer(c_int32_t) :: status
    block%n = size(f, 1, c_size_t)
    block%density = self%density
    block%deformation_gradient(1) = c_loc(f)
    ! The parts of the state; the new one replaces the old one.
    block%energies_old = c_loc(state(1, 1))
    block%invariants_old = c_loc(state(1, 5))
    block%failure_old = c_loc(state(1, 9))
    block%energies = block%energies_old
    block%invariants = block%invariants_old
    block%failure = block%failure_old
    block%stress(1) = c_loc(stress)
    block%wave_speed = c_loc(wave_speed)
    status = toron_hyperelastic_block(self%law, block, message)
  end subroutine
end module

program pull
  use, intrinsic :: iso_c_binding, only: wp => c_double
  use toron, only: toron_hyperelastic_state, toron_message_capacity
  use yarn_law, only: yarn
  implicit none

  ! N, mm, MPa, s: 100 elements of 1 mm. The first node is fixed, the last one is pulled at 100 m/s.
  integer, parameter :: n = 100
  real(wp), parameter :: length = 1, pull_speed = 100e3_wp, rise_time = 4e-6_wp
  real(wp) :: f(n, 9), state(n, toron_hyperelastic_state), stress(n, 6), wave_speed(n)
  real(wp) :: x(0:n), v(0:n), time, dt, f_point(3, 3), stress_point(6)
  type(yarn) :: kevlar
  character(toron_message_capacity) :: message
  integer :: i

  ! What a mistake looks like.
  call kevlar%prepare('kevlar-km2-600', 'mm-tonne-hours', message)
  print '(a)', trim(message)

  call kevlar%prepare('kevlar-km2-600', 'mm-tonne-s', message)
  if (message /= '') error stop message

  ! One point: 2 % longer, pressed to 80 % across.
  f_point = 0
  f_point(1, 1) = 1.02_wp
  f_point(2, 2) = 1
  f_point(3, 3) = 0.8_wp
  call kevlar%stress_at(f_point, stress_point, message)
  if (message /= '') error stop message
  print '(a, 3(1x, f0.2), a)', 'stress 11 22 33:', stress_point(1:3), ' MPa'

  ! The yarn at rest; then steps in time until an element has failed, which state variable 10 tells.
  x = [(i * length, i = 0, n)]
  v = 0
  f = spread(real([1, 0, 0, 0, 1, 0, 0, 0, 1], wp), 1, n)
  state = 0
  time = 0
  do
    f(:, 1) = (x(1:) - x(:n - 1)) / length
    call kevlar%update(f, state, stress, wave_speed, message)
    if (message /= '') error stop message
    if (any(state(:, 10) > 0.5_wp)) exit
    dt = 0.9_wp * minval((x(1:) - x(:n - 1)) / wave_speed)
    ! Force over mass, both per area, which stays what it was: F22 = F33 = 1.
    v(1:n - 1) = v(1:n - 1) + dt * (stress(2:, 1) - stress(:n - 1, 1)) / (kevlar%density * length)
    v(n) = pull_speed * min(time / rise_time, 1.0_wp)
    x = x + dt * v
    time = time + dt
  end do
  print '(a, f0.2, a, i0)', 'broken after ', time * 1e6_wp, ' microseconds in element ', maxloc(state(:, 10), 1)
end program
