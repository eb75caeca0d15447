! LECMUSER01 to LECMUSER03 for OpenRadioss's SDK: the starter reads a
! material of libtoron, /MAT/USER01 the hyperelastic yarn law,
! /MAT/USER02 the linear elastic one and /MAT/USER03 the yarn law with
! friction. The engine's part is openradioss_luser.f.
!
! The card has, behind the line of the density, fields of 20 columns,
! five a line: the properties, then options: see docs.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine lecmuser01(iin, iout, uparam, maxuparam, nuparam,
     &  nuvar, ifunc, maxfunc, nfunc, parmat, userbuf)
      use law_user, only: ulawbuf
      use law_userso, only: ulawintbuf
      implicit none
!     It is here for its reals, which are of the solver's kind.
      type(ulawintbuf), pointer :: kinds
      integer, parameter :: my_real = kind(kinds%rho0)
      integer :: iin, iout, maxuparam, nuparam, nuvar, ifunc(*)
      integer :: maxfunc, nfunc
      real(my_real) :: uparam(*), parmat(*)
      type(ulawbuf) :: userbuf
      external :: toron_lecmuser
      call toron_lecmuser(1, iin, iout, uparam, maxuparam, nuparam,
     &  nuvar, parmat)
      nfunc = 0
      end subroutine

      subroutine lecmuser02(iin, iout, uparam, maxuparam, nuparam,
     &  nuvar, ifunc, maxfunc, nfunc, parmat, userbuf)
      use law_user, only: ulawbuf
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf), pointer :: kinds
      integer, parameter :: my_real = kind(kinds%rho0)
      integer :: iin, iout, maxuparam, nuparam, nuvar, ifunc(*)
      integer :: maxfunc, nfunc
      real(my_real) :: uparam(*), parmat(*)
      type(ulawbuf) :: userbuf
      external :: toron_lecmuser
      call toron_lecmuser(2, iin, iout, uparam, maxuparam, nuparam,
     &  nuvar, parmat)
      nfunc = 0
      end subroutine

      subroutine lecmuser03(iin, iout, uparam, maxuparam, nuparam,
     &  nuvar, ifunc, maxfunc, nfunc, parmat, userbuf)
      use law_user, only: ulawbuf
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf), pointer :: kinds
      integer, parameter :: my_real = kind(kinds%rho0)
      integer :: iin, iout, maxuparam, nuparam, nuvar, ifunc(*)
      integer :: maxfunc, nfunc
      real(my_real) :: uparam(*), parmat(*)
      type(ulawbuf) :: userbuf
      external :: toron_lecmuser
      call toron_lecmuser(3, iin, iout, uparam, maxuparam, nuparam,
     &  nuvar, parmat)
      nfunc = 0
      end subroutine

!     A material of /MAT/USERnn: checks its card and writes its listing.
      subroutine toron_lecmuser(number, iin, iout, uparam, maxuparam,
     &  nuparam, nuvar, parmat)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int32_t, c_null_char, c_size_t
      use law_userso, only: ulawintbuf
      implicit none
      type(ulawintbuf), pointer :: kinds
      integer, parameter :: my_real = kind(kinds%rho0)
      integer :: number, iin, iout, maxuparam, nuparam, nuvar
      real(my_real) :: uparam(*), parmat(*)
      real(my_real) :: values(20)
      character(len=100) :: line
      character(len=20) :: field
      integer :: ios, k, n
      integer(c_int32_t) :: i, parameters, status, variables
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char) :: message(capacity)
      external :: arret

!     The kind of the solver's reals picks the precision.
      interface toron_lecm
        function toron_openradioss_lecm_f64(number, values, count,
     &    uparam, maxuparam, nuparam, nuvar, parmat, message, capacity)
     &    bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          integer(c_int32_t), value :: number, maxuparam
          real(c_double), intent(in) :: values(*)
          integer(c_size_t), value :: count, capacity
          real(c_double), intent(inout) :: uparam(*), parmat(*)
          integer(c_int32_t), intent(inout) :: nuparam, nuvar
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_int32_t) :: status
        end function
        function toron_openradioss_lecm_f32(number, values, count,
     &    uparam, maxuparam, nuparam, nuvar, parmat, message, capacity)
     &    bind(c) result(status)
          import :: c_char, c_float, c_int32_t, c_size_t
          integer(c_int32_t), value :: number, maxuparam
          real(c_float), intent(in) :: values(*)
          integer(c_size_t), value :: count, capacity
          real(c_float), intent(inout) :: uparam(*), parmat(*)
          integer(c_int32_t), intent(inout) :: nuparam, nuvar
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_int32_t) :: status
        end function
      end interface
      interface toron_listing
        function toron_openradioss_listing_f64(uparam, nuparam, line,
     &    text, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          real(c_double), intent(in) :: uparam(*)
          integer(c_int32_t), value :: nuparam, line
          character(kind=c_char), intent(inout) :: text(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_openradioss_listing_f32(uparam, nuparam, line,
     &    text, capacity) bind(c) result(status)
          import :: c_char, c_float, c_int32_t, c_size_t
          real(c_float), intent(in) :: uparam(*)
          integer(c_int32_t), value :: nuparam, line
          character(kind=c_char), intent(inout) :: text(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

      n = 0
      do while (n < size(values))
        read (iin, '(a)', iostat=ios) line
        if (ios /= 0) exit
        if (line(1:1) == '#') cycle
        do k = 1, 81, 20
          field = adjustl(line(k:k + 19))
          n = n + 1
          read (field, '(f20.0)', iostat=ios) values(n)
!         Fortran would read over blanks within a number.
          if (ios /= 0 .or. index(trim(field), ' ') > 0) then
            write (*, '(1x, 3a)') 'toron: the card has "', trim(field),
     &        '" in a field of 20 columns; allowed: one number'
            call arret(2)
            return
          end if
        end do
      end do
      status = toron_lecm(int(number, c_int32_t), values,
     &  int(n, c_size_t), uparam, int(maxuparam, c_int32_t),
     &  parameters, variables, parmat, message, capacity)
      if (status < 0) then
        call refuse
        return
      end if
      nuparam = parameters
      nuvar = variables
      i = 0
      do while (toron_listing(uparam, parameters, i, message,
     &  capacity) == 0)
        write (iout, '(*(a))') message(1:length_of_message())
        i = i + 1
      end do

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
