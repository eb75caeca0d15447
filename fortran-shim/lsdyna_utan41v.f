! utan41v of LS-DYNA, the tangent that goes with umat41v in an implicit
! analysis, a block of elements at a time (IVECT = 1).
!
! The deck is that of umat41v. The kinds of REAL, INTEGER and LOGICAL
! are those of the build, so compile this file with the object package's
! own flags.
!
! The argument list is that of R12. Packages of 2014 and 2015 have no
! UNSYM and NNPCRV.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine utan41v(cm, d1, d2, d3, d4, d5, d6, sig1, sig2, sig3,
     &  sig4, sig5, sig6, epsps, hsvs, unsym, lft, llt, dt1siz, capa,
     &  etype, tt, temps, dsave, nlqa, crv, nnpcrv, failels, cma, qmat)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int32_t, c_null_char, c_size_t
      implicit none
      real :: cm(*), d1(*), d2(*), d3(*), d4(*), d5(*), d6(*)
      real :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*)
      real :: epsps(*), hsvs(*), dt1siz(*), capa, tt, temps(*), dsave(*)
      real :: crv(*), cma(*), qmat(*)
      integer :: lft, llt, nlqa, nnpcrv(*)
      character(len=5) :: etype
      logical :: unsym, failels(*)
!     What the library needs, not what the card says: LS-DYNA hands NHV
!     to no routine. With another one F is not where it is read.
      integer(c_int32_t), parameter :: nhv = 11
      integer(c_int32_t) :: status
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char) :: message(capacity)

!     The default kind of REAL picks the precision.
      interface toron_utan_vector
        function toron_lsdyna_utan_vector_f64(cm, hsvs, nhv, lft, llt,
     &    nlq, dsave, message, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          real(c_double), intent(in) :: cm(*), hsvs(*)
          integer(c_int32_t), value :: nhv, lft, llt, nlq
          real(c_double), intent(inout) :: dsave(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_lsdyna_utan_vector_f32(cm, hsvs, nhv, lft, llt,
     &    nlq, dsave, message, capacity) bind(c) result(status)
          import :: c_char, c_float, c_int32_t, c_size_t
          real(c_float), intent(in) :: cm(*), hsvs(*)
          integer(c_int32_t), value :: nhv, lft, llt, nlq
          real(c_float), intent(inout) :: dsave(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

      status = toron_utan_vector(cm, hsvs, nhv, int(lft, c_int32_t),
     &  int(llt, c_int32_t), int(nlqa, c_int32_t), dsave,
     &  message, capacity)
!     Below -300 the elements are at fault and have no stiffness; above,
!     the deck is.
      if (status < 0 .and. status > -300) call refuse

      contains

      subroutine refuse
      integer :: length
      length = 0
      do while (message(length + 1) /= c_null_char)
        length = length + 1
      end do
      write (*, '(1x, *(a))') 'toron: ', message(1:length)
      call adios(2)
      end subroutine
      end subroutine
