C     Metal plasticity (von Mises), isotropic hardening, small steps.
C
C       sigma_y = sigma_0 + H p + Q (1 - exp(-b p)),   p the equivalent
C       plastic strain; implicit return along the radius by Newton.
C
C     PROPS   1 Young's modulus, 2 Poisson's ratio, 3 sigma_0, 4 H, 5 Q,
C             6 b
C     STATEV  1 equivalent plastic strain
C     DDSDDE  d(increment of stress)/d(increment of strain), consistent
C             with the return
C     SSE     the elastic energy of the stress; SPD plastic work
C
C     The limits of Newton's iteration are set once, before all calls.
      SUBROUTINE UEXTERNALDB(LOP,LRESTART,TIME,DTIME,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION TIME(2)
      COMMON /KLIMIT/ TOLER, MAXIT
      SAVE /KLIMIT/
      IF (LOP .EQ. 0) THEN
        TOLER = 1.D-13
        MAXIT = 50
      END IF
      RETURN
      END
C
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,RPL,DDSDDT,
     1 DRPLDE,DRPLDT,STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,
     2 CMNAME,NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     3 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),
     2 TIME(2),PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3),JSTEP(4)
      COMMON /KLIMIT/ TOLER, MAXIT
      SAVE /KLIMIT/
      DIMENSION DEV(6)
C
      EMOD = PROPS(1)
      ENU = PROPS(2)
      BULK = EMOD/(3.D0*(1.D0 - 2.D0*ENU))
      SHEAR = EMOD/(2.D0*(1.D0 + ENU))
      XLAME = BULK - 2.D0/3.D0*SHEAR
      P = STATEV(1)
C
C     Elastic stiffness and trial stress
      DO 20 J = 1, NTENS
        DO 10 I = 1, NTENS
          DDSDDE(I,J) = 0.D0
          IF (I.LE.NDI .AND. J.LE.NDI) DDSDDE(I,J) = XLAME
   10   CONTINUE
        IF (J .LE. NDI) DDSDDE(J,J) = XLAME + 2.D0*SHEAR
        IF (J .GT. NDI) DDSDDE(J,J) = SHEAR
   20 CONTINUE
      DO 40 J = 1, NTENS
        DO 30 I = 1, NTENS
          STRESS(I) = STRESS(I) + DDSDDE(I,J)*DSTRAN(J)
   30   CONTINUE
   40 CONTINUE
      CALL SINV(STRESS,SINV1,SMISES,NDI,NSHR)
C
      CALL KYIELD(P,PROPS,YIELD,HARD)
      IF (SMISES .GT. YIELD) THEN
C       Newton for the increment of p: the residual is convex.
        DP = 0.D0
        DO 50 ITER = 1, MAXIT
          CALL KYIELD(P + DP,PROPS,YIELD,HARD)
          RESID = SMISES - 3.D0*SHEAR*DP - YIELD
          DP = DP + RESID/(3.D0*SHEAR + HARD)
          IF (ABS(RESID) .LE. TOLER*SMISES) GO TO 60
   50   CONTINUE
        PNEWDT = 0.5D0
   60   CONTINUE
        CALL KYIELD(P + DP,PROPS,YIELD,HARD)
C
C       theta scales the deviator back; DEV is the unit normal.
        THETA = 1.D0 - 3.D0*SHEAR*DP/SMISES
        DO 70 I = 1, NTENS
          IF (I .LE. NDI) DEV(I) = (STRESS(I) - SINV1)/SMISES
          IF (I .GT. NDI) DEV(I) = STRESS(I)/SMISES
          STRESS(I) = STRESS(I) - 3.D0*SHEAR*DP*DEV(I)
   70   CONTINUE
        ACROSS = 2.D0*SHEAR*THETA
        ALONG = 3.D0*SHEAR*(1.D0/(1.D0 + HARD/(3.D0*SHEAR))
     1        - 1.D0 + THETA)
        DO 90 J = 1, NTENS
          DO 80 I = 1, NTENS
            DDSDDE(I,J) = -ALONG*DEV(I)*DEV(J)
            IF (I.LE.NDI .AND. J.LE.NDI)
     1        DDSDDE(I,J) = DDSDDE(I,J) + BULK - ACROSS/3.D0
   80     CONTINUE
          IF (J .LE. NDI) DDSDDE(J,J) = DDSDDE(J,J) + ACROSS
          IF (J .GT. NDI) DDSDDE(J,J) = DDSDDE(J,J) + 0.5D0*ACROSS
   90   CONTINUE
        STATEV(1) = P + DP
        SPD = SPD + YIELD*DP
        SMISES = YIELD
      END IF
      SSE = 0.5D0*SINV1**2/BULK + SMISES**2/(6.D0*SHEAR)
      RETURN
      END
C
C     The yield stress and its slope
      SUBROUTINE KYIELD(P,PROPS,YIELD,HARD)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION PROPS(6)
      DECAY = EXP(-PROPS(6)*P)
      YIELD = PROPS(3) + PROPS(4)*P + PROPS(5)*(1.D0 - DECAY)
      HARD = PROPS(4) + PROPS(5)*PROPS(6)*DECAY
      RETURN
      END
