! A Fortran project: one point of a preset yarn, drawn by 2 %.
program point
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_loc
  use toron
  implicit none
  real(c_double) :: properties(toron_hyperelastic_properties)
  real(c_double), target :: f(3, 3) = 0, stress(6)
  type(toron_hyperelastic_f64) :: law
  type(toron_point_f64) :: p
  character(toron_message_capacity) :: message
  integer(c_int32_t) :: status

  status = toron_preset('kevlar-km2-600', 'mm-tonne-s', properties, message=message)
  if (status == 0) status = toron_hyperelastic_prepare(law, properties, message)
  if (status /= 0) error stop message
  f(1, 1) = 1.02d0
  f(2, 2) = 1
  f(3, 3) = 1
  p%deformation_gradient = c_loc(f)
  p%stress = c_loc(stress)
  status = toron_hyperelastic_point(law, p, message)
  if (status /= 0) error stop message
  print '(f0.3, a)', stress(1), ' MPa'
end program
