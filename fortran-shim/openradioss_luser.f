! LUSER01 to LUSER03 for OpenRadioss's SDK: the engine's part of
! /MAT/USER01, the hyperelastic yarn law of libtoron, /MAT/USER02, its
! linear elastic law, and /MAT/USER03, the yarn law with friction. The
! starter's part is openradioss_lecmuser.f.
!
! Solids: /PROP/TYPE14 with Isolid = 1, Ismstr = 10, Iframe = 1: see
! docs. Integers have 4 bytes; the solver's kind of reals is that of
! the SDK's module.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine luser01(nel, nuparam, nuvar, nfunc, ifunc, npf, tf,
     &  time, timestep, uparam, rho, volume, eint, ngl, soundsp,
     &  viscmax, uvar, off, sigy, pla, userbuf)
      use, intrinsic :: iso_c_binding, only: c_int32_t
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf) :: userbuf
!     The solver's kind of reals.
      integer, parameter :: my_real = kind(userbuf%rho0)
      integer(c_int32_t) :: nel, nuparam, nuvar, nfunc, ifunc(*)
      integer(c_int32_t) :: npf(*), ngl(*)
      real(my_real) :: tf(*), time, timestep, uparam(*), rho(*)
      real(my_real) :: volume(*), eint(*), soundsp(*), viscmax(*)
      real(my_real) :: uvar(*), off(*), sigy(*), pla(*)
      external :: toron_luser
      call toron_luser(nel, nuparam, nuvar, time, uparam, ngl, soundsp,
     &  viscmax, uvar, off, userbuf)
      end subroutine

      subroutine luser02(nel, nuparam, nuvar, nfunc, ifunc, npf, tf,
     &  time, timestep, uparam, rho, volume, eint, ngl, soundsp,
     &  viscmax, uvar, off, sigy, pla, userbuf)
      use, intrinsic :: iso_c_binding, only: c_int32_t
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf) :: userbuf
      integer, parameter :: my_real = kind(userbuf%rho0)
      integer(c_int32_t) :: nel, nuparam, nuvar, nfunc, ifunc(*)
      integer(c_int32_t) :: npf(*), ngl(*)
      real(my_real) :: tf(*), time, timestep, uparam(*), rho(*)
      real(my_real) :: volume(*), eint(*), soundsp(*), viscmax(*)
      real(my_real) :: uvar(*), off(*), sigy(*), pla(*)
      external :: toron_luser
      call toron_luser(nel, nuparam, nuvar, time, uparam, ngl, soundsp,
     &  viscmax, uvar, off, userbuf)
      end subroutine

      subroutine luser03(nel, nuparam, nuvar, nfunc, ifunc, npf, tf,
     &  time, timestep, uparam, rho, volume, eint, ngl, soundsp,
     &  viscmax, uvar, off, sigy, pla, userbuf)
      use, intrinsic :: iso_c_binding, only: c_int32_t
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf) :: userbuf
      integer, parameter :: my_real = kind(userbuf%rho0)
      integer(c_int32_t) :: nel, nuparam, nuvar, nfunc, ifunc(*)
      integer(c_int32_t) :: npf(*), ngl(*)
      real(my_real) :: tf(*), time, timestep, uparam(*), rho(*)
      real(my_real) :: volume(*), eint(*), soundsp(*), viscmax(*)
      real(my_real) :: uvar(*), off(*), sigy(*), pla(*)
      external :: toron_luser
      call toron_luser(nel, nuparam, nuvar, time, uparam, ngl, soundsp,
     &  viscmax, uvar, off, userbuf)
      end subroutine

!     A group of elements. The library reads and writes the solver's own
!     arrays.
      subroutine toron_luser(nel, nuparam, nuvar, time, uparam, ngl,
     &  soundsp, viscmax, uvar, off, userbuf)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int32_t, c_null_char, c_size_t
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf) :: userbuf
      integer, parameter :: my_real = kind(userbuf%rho0)
      integer(c_int32_t) :: nel, nuparam, nuvar, ngl(*)
      real(my_real) :: time, uparam(*), soundsp(*), viscmax(*)
      real(my_real) :: uvar(*), off(*)
!     Of the eight nodes of each element.
      real(my_real) :: nodes(nel * 24)
      integer(c_int32_t) :: status
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char) :: message(capacity)
      external :: arret, mat_solid_get_nod_x

!     The kind of the solver's reals picks the precision.
      interface toron_luser_of
        function toron_openradioss_luser_f64(nel, nuparam, nuvar, time,
     &    uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx,
     &    fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz,
     &    signzx, sigvxx, sigvyy, sigvzz, sigvxy, sigvyz, sigvzx,
     &    soundsp, viscmax, uvar, off, nodes, message, capacity) bind(c)
     &    result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          integer(c_int32_t), value :: nel, nuparam, nuvar
          real(c_double), value :: time
          integer(c_int32_t), intent(in) :: ngl(*)
          real(c_double), intent(in) :: uparam(*), rho0(*)
          real(c_double), intent(in) :: fpsxx(*), fpsyy(*), fpszz(*)
          real(c_double), intent(in) :: fpsxy(*), fpsyz(*), fpszx(*)
          real(c_double), intent(in) :: fpsyx(*), fpszy(*), fpsxz(*)
          real(c_double), intent(in) :: nodes(*)
          real(c_double), intent(inout) :: signxx(*), signyy(*)
          real(c_double), intent(inout) :: signzz(*)
          real(c_double), intent(inout) :: signxy(*), signyz(*)
          real(c_double), intent(inout) :: signzx(*)
          real(c_double), intent(inout) :: sigvxx(*), sigvyy(*)
          real(c_double), intent(inout) :: sigvzz(*)
          real(c_double), intent(inout) :: sigvxy(*), sigvyz(*)
          real(c_double), intent(inout) :: sigvzx(*)
          real(c_double), intent(inout) :: soundsp(*), viscmax(*)
          real(c_double), intent(inout) :: uvar(*), off(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_openradioss_luser_f32(nel, nuparam, nuvar, time,
     &    uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx,
     &    fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz,
     &    signzx, sigvxx, sigvyy, sigvzz, sigvxy, sigvyz, sigvzx,
     &    soundsp, viscmax, uvar, off, nodes, message, capacity) bind(c)
     &    result(status)
          import :: c_char, c_float, c_int32_t, c_size_t
          integer(c_int32_t), value :: nel, nuparam, nuvar
          real(c_float), value :: time
          integer(c_int32_t), intent(in) :: ngl(*)
          real(c_float), intent(in) :: uparam(*), rho0(*)
          real(c_float), intent(in) :: fpsxx(*), fpsyy(*), fpszz(*)
          real(c_float), intent(in) :: fpsxy(*), fpsyz(*), fpszx(*)
          real(c_float), intent(in) :: fpsyx(*), fpszy(*), fpsxz(*)
          real(c_float), intent(in) :: nodes(*)
          real(c_float), intent(inout) :: signxx(*), signyy(*)
          real(c_float), intent(inout) :: signzz(*)
          real(c_float), intent(inout) :: signxy(*), signyz(*)
          real(c_float), intent(inout) :: signzx(*)
          real(c_float), intent(inout) :: sigvxx(*), sigvyy(*)
          real(c_float), intent(inout) :: sigvzz(*)
          real(c_float), intent(inout) :: sigvxy(*), sigvyz(*)
          real(c_float), intent(inout) :: sigvzx(*)
          real(c_float), intent(inout) :: soundsp(*), viscmax(*)
          real(c_float), intent(inout) :: uvar(*), off(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

!     Crimped yarns take the fibre from the nodes in the first cycle.
      if (time <= 0) call mat_solid_get_nod_x(nodes)
      status = toron_luser_of(nel, nuparam, nuvar, time, uparam, ngl,
     &  userbuf%rho0, userbuf%fpsxx, userbuf%fpsyy, userbuf%fpszz,
     &  userbuf%fpsxy, userbuf%fpsyz, userbuf%fpszx, userbuf%fpsyx,
     &  userbuf%fpszy, userbuf%fpsxz, userbuf%signxx, userbuf%signyy,
     &  userbuf%signzz, userbuf%signxy, userbuf%signyz, userbuf%signzx,
     &  userbuf%sigvxx, userbuf%sigvyy, userbuf%sigvzz, userbuf%sigvxy,
     &  userbuf%sigvyz, userbuf%sigvzx, soundsp, viscmax, uvar, off,
     &  nodes, message, capacity)
      if (status < 0) call refuse

      contains

      subroutine refuse
      write (*, '(1x, *(a))') 'toron: ', message(1:length_of_message())
      call arret(2)
      end subroutine

      integer function length_of_message()
      length_of_message = 0
      do while (message(length_of_message + 1) /= c_null_char)
        length_of_message = length_of_message + 1
      end do
      end function
      end subroutine
