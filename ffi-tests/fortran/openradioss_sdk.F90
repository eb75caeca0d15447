! The modules of OpenRadioss's SDK as far as the shims see them: the names of the components, and arrays of the solver's vector length.
module law_user
  implicit none
  type ulawbuf
    integer :: id
    character(len=500) :: name
  end type
end module

module law_userso
  use, intrinsic :: iso_c_binding, only: c_double, c_float
  implicit none
#ifdef SINGLE
  integer, parameter :: my_real = c_float
#else
  integer, parameter :: my_real = c_double
#endif
  integer, parameter :: mvsiz = 129
  type ulawintbuf
    integer :: ncycle, id
    real(my_real), dimension(mvsiz) :: fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx, fpsyx, fpszy, fpsxz
    real(my_real), dimension(mvsiz) :: sigoxx, sigoyy, sigozz, rho0
    real(my_real), dimension(mvsiz) :: signxx, signyy, signzz, signxy, signyz, signzx
    real(my_real), dimension(mvsiz) :: sigvxx, sigvyy, sigvzz, sigvxy, sigvyz, sigvzx
  end type
end module
